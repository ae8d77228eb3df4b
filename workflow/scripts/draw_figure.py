"""Draw the figure that the rule's parameter `figure` names, as a PNG and a PDF."""

from importlib import import_module
from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.paths import as_paths

log_to(snakemake.log[0])
name = snakemake.params.figure
module = import_module(f"morphoskel.reporting.figures.{snakemake.params.get('module', name)}")
draw = getattr(module, f"draw_{name}_from_files")
draw([Path(path) for path in snakemake.output], **as_paths(snakemake.params.files), **snakemake.params.values)
