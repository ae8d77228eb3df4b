"""Figure: candidates in the box of a shape, and those that lie inside."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from morphoskel.reporting.figure_page import cropped
from morphoskel.reporting.figures.panels import Row, draw_rows
from morphoskel.reporting.figures.section_view import SectionView, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration
from morphoskel.reporting.render import Canvas, Image
from morphoskel.shapes import FloatArray

OUTSIDE_COLOUR, EDGE_COLOUR = (0.78, 0.8, 0.83), (0.45, 0.47, 0.5)

OUTSIDE_SIZE, INSIDE_SIZE, EDGE_SIZE = 0.0018, 0.0055, 0.0014
"""Radii of the dots, in sides of the picture."""

EDGE_DOTS = 800
"""Along each edge of the box; so many that they form a line."""


def draw_occupancy(paths: Sequence[Path], few: Illustration, many: Illustration, *, pixels: int = 1000) -> None:
    """Draw the candidates of one illustration, and the inner points of another of the same shape.

    Parameters
    ----------
    paths
        Files to write.
    few
        Its candidates are drawn in their box, those inside as larger dots.
    many
        Its inner points are drawn.
    pixels
        Side of each picture.
    """
    view = section_view(many, pixels)
    pictures = cropped([draw_candidates(view, few), view.draw_inner(many, view.by_depth(many.inner), cut=False)])
    shown = "" if len(few.candidates) == few.candidate_count else f"{len(few.candidates):,} of "
    titles = (
        f"{shown}{few.candidate_count:,} candidates, {few.inner_count:,} inside",
        f"{many.inner_count:,} inner points of {many.candidate_count:,} candidates",
    )
    draw_rows(paths, [Row(pictures, titles=titles)])


def draw_occupancy_from_files(paths: Sequence[Path], few: Path, many: Path, *, pixels: int = 1000) -> None:
    """Draw the figure from two files with illustrations, see :func:`draw_occupancy`."""
    draw_occupancy(paths, read_illustration(few), read_illustration(many), pixels=pixels)


def draw_candidates(view: SectionView, illustration: Illustration) -> Image:
    """Draw the candidates in their box, those inside as larger dots."""
    canvas, inside = view.canvas(), illustration.inside
    canvas.add_points(illustration.candidates[~inside], OUTSIDE_COLOUR, OUTSIDE_SIZE)
    points = illustration.candidates[inside]
    canvas.add_points(points, view.by_depth(points), INSIDE_SIZE)
    add_box(canvas, view.bounds)
    return canvas.image()


def add_box(canvas: Canvas, bounds: FloatArray) -> None:
    """Add the twelve edges of a box, ``(2, 3)``."""
    lower, upper = bounds
    along = np.linspace(0.0, 1.0, EDGE_DOTS)
    for axis in range(3):
        for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
            shares = np.insert(np.tile(np.array(corner, dtype=np.float64), (EDGE_DOTS, 1)), axis, along, axis=1)
            canvas.add_points(lower + shares * (upper - lower), EDGE_COLOUR, EDGE_SIZE)
