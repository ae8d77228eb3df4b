"""Tables and pictures: what the paper printed beside what was computed here."""
