"""Draw the first skeleton of every category on every surface reconstruction."""

from pathlib import Path

from morphoskel.datasets.manifest import read_manifest
from morphoskel.logs import log_to
from morphoskel.reporting.skeleton_gallery import draw_skeleton_gallery

log_to(snakemake.log[0])
meshes, skeletons = (
    {surface: [Path(folder) for folder in folders] for surface, folders in by_surface.items()}
    for by_surface in (snakemake.params.meshes, snakemake.params.skeletons)
)
records = read_manifest(Path(snakemake.input.manifest), split=snakemake.params.split)
draw_skeleton_gallery(Path(snakemake.output[0]), records, meshes, skeletons)
