"""Time every stage of the chain on a few shapes."""

from pathlib import Path

from morphoskel.checksums import checked_file
from morphoskel.evaluation.timing import time_stages
from morphoskel.logs import log_to

log_to(snakemake.log[0])
rows = time_stages(
    Path(snakemake.input.manifest),
    split=snakemake.wildcards.split,
    surface=snakemake.wildcards.surface,
    sections=dict(snakemake.params.items()),
    seed=snakemake.params.seed,
    shapes_per_category=snakemake.params.timing["shapes_per_category"],
    threads=snakemake.threads,
)
with checked_file(Path(snakemake.output[0])) as path:
    rows.to_csv(path, index=False)
