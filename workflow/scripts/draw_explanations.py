"""Draw the first shapes, coloured by how far their balls leave them unexplained."""

from pathlib import Path

from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import first_of_each_category, read_manifest
from morphoskel.formats import read_skeleton_ply
from morphoskel.logs import log_to
from morphoskel.reporting.explanation_figure import draw_explanations
from morphoskel.reporting.names import method_name

log_to(snakemake.log[0])
dataset = open_configured(snakemake.params.dataset, seed=snakemake.params.seed)
skeletons = {
    method_name(*reversed(pair.split("/"))): {
        path.stem: path for folder in folders for path in Path(folder).glob("*.ply")
    }
    for pair, folders in snakemake.params.skeletons.items()
}
records = [
    record
    for record in first_of_each_category(read_manifest(Path(snakemake.input.manifest), split=snakemake.params.split))
    if all(record.id in paths for paths in skeletons.values())
]
draw_explanations(
    Path(snakemake.output[0]),
    {record.category: dataset.load(record.path) for record in records},
    {name: [read_skeleton_ply(paths[record.id]) for record in records] for name, paths in skeletons.items()},
)
