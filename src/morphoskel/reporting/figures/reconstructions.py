"""What surface reconstructions do to the skeleton: closed surfaces, and below them the balls of MS3D."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from morphoskel.progress import track
from morphoskel.reporting.figures.ball_panels import RADIUS_SCALE, draw_in_surface, joint_bounds
from morphoskel.reporting.figures.panels import Row, crop_alike, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_records, find_skeleton, find_surface
from morphoskel.reporting.names import surface_name
from morphoskel.reporting.render import FROM_THE_FRONT, Canvas, Image, View, ball_bounds
from morphoskel.shapes import FloatArray, Mesh, Skeleton

LARGE = replace(FROM_THE_FRONT, pixels=560)
WANTED = ("chair", "earphone", "airplane")
"""Categories shown first, if the data set has them: sheets, thin curves and parts close to each other."""

SHAPES = 3


@dataclass(frozen=True)
class Rebuilt:
    """A shape under one surface reconstruction.

    Parameters
    ----------
    surface
        Closed, or what to say in its place.
    skeleton
        Its balls, likewise.
    """

    surface: Mesh | str
    skeleton: Skeleton | str


def draw_reconstructions(
    paths: Sequence[Path], shapes: Mapping[str, Mapping[str, Rebuilt]], *, view: View = LARGE
) -> None:
    """Draw two rows a shape, its surfaces and their balls, and one column a reconstruction.

    All pictures of a shape have the same scale and camera, and one scale of colours.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each title of a shape and of a reconstruction what came of it; the same reconstructions of every shape.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    rows: list[Row] = []
    for name, of_shape in track(shapes.items(), "reconstructions"):
        surfaces, balls = _draw(list(of_shape.values()), view)
        rows.append(Row(surfaces, name=name, titles=() if rows else list(of_shape)))
        rows.append(Row(balls))
    draw_rows(paths, rows, scale=RADIUS_SCALE)


def _draw(rebuilt: Sequence[Rebuilt], view: View) -> tuple[list[Image | str], list[Image | str]]:
    """Return the pictures of the surfaces of a shape, and of the balls in them."""
    found = [skeleton for each in rebuilt if not isinstance(skeleton := each.skeleton, str)]
    boxes: list[FloatArray] = [ball_bounds(skeleton) for skeleton in found]
    boxes += [joint_bounds([surface.bounds]) for each in rebuilt if not isinstance(surface := each.surface, str)]
    if not boxes:
        return [str(each.surface) for each in rebuilt], [str(each.skeleton) for each in rebuilt]
    largest = max((float(skeleton.radii.max()) for skeleton in found), default=1.0)
    bounds = joint_bounds(boxes)
    panels: list[Image | str] = [
        each.surface if isinstance(each.surface, str) else _surface(each.surface, view, bounds) for each in rebuilt
    ]
    panels += [draw_in_surface(each.surface, each.skeleton, view, bounds, largest=largest) for each in rebuilt]
    shown = crop_alike(panels)
    return shown[: len(rebuilt)], shown[len(rebuilt) :]


def _surface(mesh: Mesh, view: View, bounds: FloatArray) -> Image:
    canvas = Canvas(view, bounds)
    canvas.add_mesh(mesh)
    return canvas.image()


def draw_reconstructions_from_files(
    paths: Sequence[Path],
    manifest: Path,
    surfaces: Mapping[str, Sequence[Path]],
    skeletons: Mapping[str, Sequence[Path]],
    *,
    split: str,
    wanted: Sequence[str] = WANTED,
    count: int = SHAPES,
    view: View = LARGE,
) -> None:
    """Draw the first shape of each of several categories.

    Parameters
    ----------
    paths
        Files to write.
    manifest
        Of the data set.
    surfaces, skeletons
        For each reconstruction, by its name in the configuration, the folders of all shards of the split with closed
        surfaces, and with skeletons of MS3D.
    split
        Which shapes.
    wanted, count
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.
    """
    from morphoskel.datasets.manifest import read_manifest

    records = read_manifest(manifest, split=split)
    shapes = {
        title: {
            surface_name(name): Rebuilt(find_surface(folders, record.id), find_skeleton(skeletons[name], record.id))
            for name, folders in surfaces.items()
        }
        for title, record in choose_records(records, wanted=wanted, count=count).items()
    }
    draw_reconstructions(paths, shapes, view=view)
