"""Measure the distances between each skeleton and its cloud, and between its centres and the reference axis."""

from pathlib import Path

from morphoskel.checksums import checked_file
from morphoskel.evaluation.skeletons import Balls, check_failures, evaluate_skeletons
from morphoskel.logs import log_to

log_to(snakemake.log[0])
rows = evaluate_skeletons(
    Path(snakemake.input.manifest),
    [Path(folder) for folder in snakemake.input.skeletons],
    [Path(folder) for folder in snakemake.input.axes],
    split=snakemake.wildcards.split,
    dataset=snakemake.params.dataset,
    seed=snakemake.params.seed,
    surface=snakemake.wildcards.surface,
    method=snakemake.wildcards.skeleton,
    balls=Balls(**snakemake.params.balls),
)
check_failures(rows.to_dict("records"), snakemake.params.max_failed)
with checked_file(Path(snakemake.output[0])) as path:
    rows.to_csv(path, index=False)
