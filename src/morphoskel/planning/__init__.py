"""What an experiment will cost, from the jobs that Snakemake plans and the times and sizes that a run has measured."""
