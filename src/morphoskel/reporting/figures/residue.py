"""Figure: the residue of the inner points, and those of smallest residue, which form the skeleton."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from morphoskel.reporting.figure_page import (
    DISTANCE_MAP,
    RESIDUE_MAP,
    TEXT_WIDTH,
    add_scale,
    cropped,
    figure_page,
    show,
)
from morphoskel.reporting.figures.section_view import largest_distance, largest_residue, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration

SCALES_WIDTH = 1.5
"""Inches that both colour bars take."""


def draw_residue(paths: Sequence[Path], illustration: Illustration, *, pixels: int = 1000) -> None:
    """Draw the residue of the shape cut in two, and beside it its skeleton, coloured by UDF.

    Parameters
    ----------
    paths
        Files to write.
    illustration
        The shape.
    pixels
        Side of each picture.
    """
    view, farthest, largest = (
        section_view(illustration, pixels),
        largest_distance(illustration),
        largest_residue(illustration),
    )
    pictures = cropped([view.draw_residues(illustration, largest), view.draw_selected(illustration, farthest)])
    high, wide = pictures[0].shape[:2]
    with figure_page(paths, TEXT_WIDTH, (TEXT_WIDTH - SCALES_WIDTH) / 2 * high / wide + 0.25) as figure:
        left, right = figure.subplots(1, 2)
        show(left, pictures[0], "residue: dilation minus UDF")
        show(right, pictures[1], f"the {len(illustration.selected):,} points of smallest residue")
        add_scale(figure, left, 0, largest, RESIDUE_MAP, "residue, in the shape's unit")
        add_scale(figure, right, 0, farthest, DISTANCE_MAP, "UDF, in the shape's unit")


def draw_residue_from_files(paths: Sequence[Path], illustration: Path, *, pixels: int = 1000) -> None:
    """Draw the figure from a file with an illustration, see :func:`draw_residue`."""
    draw_residue(paths, read_illustration(illustration), pixels=pixels)
