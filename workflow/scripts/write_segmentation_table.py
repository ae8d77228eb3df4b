"""Write the table of part segmentation as CSV, Markdown and LaTeX."""

from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.segmentation_table_files import write_segmentation_table

log_to(snakemake.log[0])
write_segmentation_table(
    [Path(path) for path in snakemake.input.rows],
    Path(snakemake.input.published).parent,
    Path(snakemake.output.csv).with_suffix(""),
    snakemake.params.provenance,
)
