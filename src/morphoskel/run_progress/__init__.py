"""How far a run of the workflow is, how long it will take, and what came of it, in lines for people who wait."""
