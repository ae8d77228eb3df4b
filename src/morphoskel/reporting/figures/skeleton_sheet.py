"""A sheet with the skeleton of one shape of every category of a data set, in its surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from morphoskel.progress import track
from morphoskel.reporting.figure_page import cropped
from morphoskel.reporting.figures.ball_panels import RADIUS_SCALE, draw_balls, joint_bounds
from morphoskel.reporting.figures.panels import Row, draw_rows
from morphoskel.reporting.figures.shown_shapes import choose_records, find_skeleton, find_surface
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View, ball_bounds
from morphoskel.shapes import Mesh, Skeleton

LARGE = replace(FROM_THE_FRONT, pixels=480)

MOST_COLUMNS = 6


def draw_skeleton_sheet(
    paths: Sequence[Path], shapes: Mapping[str, tuple[Mesh | str, Skeleton | str]], *, view: View = LARGE
) -> None:
    """Draw balls coloured by radius under a veil, in rows of nearly equal length.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each title the closed surface, left out where it is words, and the skeleton, or what to say in its place.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    panels = [_draw(surface, skeleton, view) for surface, skeleton in track(shapes.values(), "sheet of skeletons")]
    titles = list(shapes)
    rows = -(-len(panels) // MOST_COLUMNS)
    columns = -(-len(panels) // max(rows, 1))
    starts = range(0, len(panels), max(columns, 1))
    draw_rows(
        paths,
        [Row(panels[start : start + columns], titles=titles[start : start + columns]) for start in starts],
        scale=RADIUS_SCALE,
    )


def _draw(surface: Mesh | str, skeleton: Skeleton | str, view: View) -> Image | str:
    if isinstance(skeleton, str):
        return skeleton
    veil = None if isinstance(surface, str) else surface
    bounds = joint_bounds([ball_bounds(skeleton), *([veil.bounds] if veil else [])])
    return cropped([draw_balls(skeleton, view, bounds, veil=veil)])[0]


def draw_skeleton_sheet_from_files(
    paths: Sequence[Path],
    manifest: Path,
    surfaces: Sequence[Path],
    skeletons: Sequence[Path],
    *,
    split: str,
    view: View = LARGE,
) -> None:
    """Draw the first shape of every category.

    Parameters
    ----------
    paths
        Files to write.
    manifest
        Of the data set.
    surfaces, skeletons
        The folders of all shards of the split with closed surfaces, and with the skeletons made of them.
    split
        Which shapes.
    view
        The camera.
    """
    from morphoskel.datasets.manifest import read_manifest

    records = read_manifest(manifest, split=split)
    shapes = {
        title: (find_surface(surfaces, record.id), find_skeleton(skeletons, record.id))
        for title, record in choose_records(records).items()
    }
    draw_skeleton_sheet(paths, shapes, view=view)
