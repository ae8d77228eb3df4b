"""Bring the clouds of a split to the same size and number of points."""

from pathlib import Path

from morphoskel.datasets.cloud_set import gather_clouds, write_cloud_set
from morphoskel.logs import log_to

log_to(snakemake.log[0])
clouds = gather_clouds(
    Path(snakemake.input.manifest),
    snakemake.wildcards.split,
    dataset=snakemake.params.dataset,
    points=int(snakemake.params.points),
    repeat=snakemake.params.repeat,
    seed=snakemake.params.seed,
)
write_cloud_set(clouds, Path(snakemake.output[0]))
