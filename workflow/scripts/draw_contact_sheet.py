"""Draw the first shapes of every category, coloured by part."""

from collections import defaultdict
from pathlib import Path

from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import read_manifest
from morphoskel.logs import log_to
from morphoskel.reporting.contact_sheet import draw_contact_sheet

SHAPES_A_ROW = 6

log_to(snakemake.log[0])
dataset = open_configured(snakemake.params.dataset, seed=snakemake.params.seed)
shapes = defaultdict(list)
for record in read_manifest(Path(snakemake.input.manifest), split=snakemake.params.split):
    if len(shapes[record.category]) < SHAPES_A_ROW:
        shapes[record.category].append(dataset.load(record.path))
draw_contact_sheet(shapes, Path(snakemake.output[0]))
