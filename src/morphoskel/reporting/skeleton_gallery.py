"""A page of skeletons: one row a method and surface reconstruction, one column a category."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.atomic import atomic_file
from morphoskel.chain.status import read_status
from morphoskel.datasets.manifest import ShapeRecord, first_of_each_category
from morphoskel.errors import InputError
from morphoskel.formats import read_skeleton_ply
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.reporting.contact_sheet import FROM_THE_FRONT
from morphoskel.reporting.names import method_name
from morphoskel.reporting.render import View, render_balls
from morphoskel.reporting.skeleton_picture import colour_by_radius

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TILE_INCHES = 1.7


def draw_skeleton_gallery(
    path: Path,
    records: Sequence[ShapeRecord],
    meshes: Mapping[str, Sequence[Path]],
    skeletons: Mapping[str, Sequence[Path]],
    *,
    view: View = FROM_THE_FRONT,
) -> None:
    """Draw the first shape of each category under every method and surface reconstruction.

    Parameters
    ----------
    path
        The PNG to write.
    records
        The shapes of a split.
    meshes
        For each surface reconstruction, the folders of all shards with closed surfaces.
    skeletons
        For each surface and method, joined with a slash, the folders of all shards with skeletons. Those of a method
        without a surface are drawn in the first surface there is.
    view
        The camera.

    Raises
    ------
    InputError
        If there is nothing to draw.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    first = {record.category: record for record in first_of_each_category(records)}
    if not first or not skeletons or not meshes:
        raise InputError("a gallery needs at least one shape, one surface reconstruction and one method")
    size = (TILE_INCHES * len(first) + 0.25, TILE_INCHES * len(skeletons) + 0.25)
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    tiles = figure.subplots(len(skeletons), len(first), squeeze=False)
    for row, pair in zip(tiles, skeletons, strict=True):
        surface, _, method = pair.partition("/")
        folders = meshes.get(surface, next(iter(meshes.values())))
        row[0].set_ylabel(method_name(method, surface).replace(", ", "\n"), fontsize=8)
        for axes, record in zip(row, first.values(), strict=True):
            axes.set(xticks=[], yticks=[], frame_on=False)
            _draw(axes, record.id, folders, skeletons[pair], view)
    for axes, category in zip(tiles[0], first, strict=True):
        axes.set_title(category)
    with atomic_file(path) as partial:
        figure.savefig(partial, dpi=view.pixels / TILE_INCHES, format="png")


def _draw(axes: Axes, shape: str, meshes: Sequence[Path], skeletons: Sequence[Path], view: View) -> None:
    """Draw one skeleton, or say why there is none."""
    status = {row.id: (row, folder) for folder in skeletons for row in read_status(folder)}
    row, folder = status[shape]
    if row.status == "failed":
        axes.text(0.5, 0.5, f"failed at {row.stage}", ha="center", va="center", fontsize=7)
        return
    skeleton = read_skeleton_ply(folder / f"{shape}.ply")
    surface = next((read_mesh(mesh / f"{shape}.ply") for mesh in meshes if (mesh / f"{shape}.ply").exists()), None)
    colours, _ = colour_by_radius(skeleton)
    axes.imshow(render_balls(skeleton, colours, view, under=surface), interpolation="antialiased")
