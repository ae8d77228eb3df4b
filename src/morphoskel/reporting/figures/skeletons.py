"""A page of skeletons: one row a method and surface reconstruction, one column a shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from morphoskel.progress import track
from morphoskel.reporting.figures.ball_panels import RADIUS_SCALE, draw_in_surface, joint_bounds
from morphoskel.reporting.figures.panels import Row, crop_alike, draw_rows
from morphoskel.reporting.figures.shown_shapes import NOT_THERE, choose_records, find_skeleton, find_surface
from morphoskel.reporting.names import method_name
from morphoskel.reporting.render import FROM_THE_FRONT, Image, View, ball_bounds
from morphoskel.shapes import FloatArray, Mesh, Skeleton

LARGE = replace(FROM_THE_FRONT, pixels=320)
SHAPES = 8
WANTED = ("airplane", "chair", "earphone", "guitar", "lamp", "mug", "table")
"""Categories shown first, if the data set has them: sheets, thin curves and thick parts."""

HEIGHT = 0.92
"""Of a panel, in widths; one for all rows, so that all skeletons of a shape have one scale."""

REACH = 0.2
"""How far the pictures may reach beyond a shape, in its longest sides; one huge ball would leave a dot of the shape."""

SCALE = replace(RADIUS_SCALE, label="ball radius, relative to the\nlargest (median of the rows)")


def draw_skeletons(
    paths: Sequence[Path], shapes: Mapping[str, Mapping[str, tuple[Mesh | str, Skeleton | str]]], *, view: View = LARGE
) -> None:
    """Draw the skeletons of each shape below each other, as balls under a veil.

    All pictures of a shape have the same scale and camera, and one scale of colours. It ends at the median of the
    largest radii of its skeletons, so that one ball that is too large does not darken all others.

    Parameters
    ----------
    paths
        Files to write.
    shapes
        For each title of a shape and each name of a row the closed surface, left out where it is words, and the
        skeleton, or what to say in its place; the same rows of every shape.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no shape.
    """
    columns = [_draw(list(of_shape.values()), view) for of_shape in track(shapes.values(), "skeletons")]
    names = next(iter(shapes.values()), {})
    rows = [
        Row([column[number] for column in columns], name=name, titles=() if number else list(shapes))
        for number, name in enumerate(names)
    ]
    draw_rows(paths, rows, scale=SCALE, flattest=HEIGHT, tallest=HEIGHT, level_names=True)


def _draw(of_shape: Sequence[tuple[Mesh | str, Skeleton | str]], view: View) -> list[Image | str]:
    """Return the pictures of the skeletons of one shape."""
    found = [skeleton for _, skeleton in of_shape if not isinstance(skeleton, str)]
    if not found:
        return [str(words) for _, words in of_shape]
    bounds = joint_bounds(ball_bounds(skeleton) for skeleton in found)
    surfaces = [surface.bounds for surface, _ in of_shape if not isinstance(surface, str)]
    if surfaces:
        bounds = _within_reach(joint_bounds([bounds, *surfaces]), joint_bounds(surfaces))
    largest = float(np.median([skeleton.radii.max() for skeleton in found]))
    return crop_alike([draw_in_surface(*each, view, bounds, largest=largest) for each in of_shape])


def _within_reach(bounds: FloatArray, of_surfaces: FloatArray) -> FloatArray:
    reach = REACH * float(np.ptp(of_surfaces, axis=0).max())
    limited: FloatArray = np.clip(bounds, of_surfaces[0] - reach, of_surfaces[1] + reach)
    return limited


def draw_skeletons_from_files(
    paths: Sequence[Path],
    manifest: Path,
    meshes: Mapping[str, Sequence[Path]],
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
    meshes
        For each surface reconstruction, by its name in the configuration, the folders of all shards of the split with
        closed surfaces.
    skeletons
        For each surface and method, joined with a slash, the folders of all shards with skeletons. Those of a method
        without a surface are drawn in the first surface there is.
    split
        Which shapes.
    wanted, count
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.
    """
    from morphoskel.datasets.manifest import read_manifest

    shapes: dict[str, dict[str, tuple[Mesh | str, Skeleton | str]]] = {}
    records = read_manifest(manifest, split=split)
    for title, record in choose_records(records, wanted=wanted, count=count).items():
        surfaces = {name: find_surface(folders, record.id) for name, folders in meshes.items()}
        first = next((surface for surface in surfaces.values() if not isinstance(surface, str)), NOT_THERE)
        shapes[title] = {}
        for pair, folders in skeletons.items():
            surface, _, method = pair.partition("/")
            shown = surfaces.get(surface, first), find_skeleton(folders, record.id)
            shapes[title][method_name(method, surface)] = shown
    draw_skeletons(paths, shapes, view=view)
