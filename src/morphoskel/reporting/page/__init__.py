"""The HTML report of a run: one page that holds tables, figures, shapes to turn, and how they came to be."""
