"""Time occupancy, UDF and dilation for growing numbers of candidates in the shape of the overview."""

from pathlib import Path

from morphoskel.evaluation.scaling import write_scaling
from morphoskel.logs import log_to
from morphoskel.reporting.illustration_file import read_illustration

log_to(snakemake.log[0])
write_scaling(
    read_illustration(Path(snakemake.input[0])).surface,
    Path(snakemake.output[0]),
    snakemake.params.counts,
    k=snakemake.params.k,
    seed=snakemake.params.seed,
    repeats=snakemake.params.repeats,
    threads=snakemake.threads,
)
