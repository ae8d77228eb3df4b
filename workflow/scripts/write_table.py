"""Write one of the paper's tables, named like the rule, as CSV, Markdown and LaTeX."""

from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.skeleton_table_files import write_skeleton_table

log_to(snakemake.log[0])
write_skeleton_table(
    snakemake.rule.removeprefix("table_"),
    [Path(path) for path in snakemake.input.rows],
    Path(snakemake.input.published).parent,
    Path(snakemake.output.csv).with_suffix(""),
    snakemake.params.provenance,
)
