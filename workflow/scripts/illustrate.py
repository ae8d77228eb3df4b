"""Take one shape through the chain and keep all that lies between the stages."""

from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.illustration_file import illustrate_to_file

CLOUD_POINTS = 20_000

log_to(snakemake.log[0])
shape, params = snakemake.wildcards.shape, snakemake.params
illustrate_to_file(
    Path(snakemake.output[0]),
    params.overview if shape == "overview" else shape,
    samples=CLOUD_POINTS,
    candidates={"mode": snakemake.wildcards.mode, "count": int(snakemake.wildcards.candidates)},
    k=params.skeleton["k"],
    points=params.skeleton["points"],
    seed=params.seed,
    watertight_settings=params.watertight,
    threads=snakemake.threads,
)
