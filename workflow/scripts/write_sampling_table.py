"""Write one of the tables of samplers, named like the rule, as CSV, Markdown and LaTeX."""

from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.sampling_table_files import write_sampling_table

log_to(snakemake.log[0])
write_sampling_table(
    snakemake.rule.removeprefix("table_"),
    [Path(path) for path in snakemake.input.shapes],
    [Path(path) for path in snakemake.input.draws],
    Path(snakemake.input.published).parent,
    Path(snakemake.output.csv).with_suffix(""),
    snakemake.params.provenance,
)
