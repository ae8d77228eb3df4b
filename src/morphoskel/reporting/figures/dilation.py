"""Figure: the distance function of the inner points, and its dilation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from morphoskel.reporting.figure_page import DISTANCE_MAP, cropped
from morphoskel.reporting.figures.panels import Row, Scale, draw_rows
from morphoskel.reporting.figures.section_view import largest_distance, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration


def draw_dilation(paths: Sequence[Path], illustration: Illustration, *, pixels: int = 1000) -> None:
    """Draw UDF and dilation side by side on one scale, the shape cut in two.

    Parameters
    ----------
    paths
        Files to write.
    illustration
        The shape.
    pixels
        Side of each picture.
    """
    view, largest = section_view(illustration, pixels), largest_distance(illustration)
    fields = (illustration.udf, illustration.dilated)
    pictures = cropped([view.draw_distances(illustration, field, largest) for field in fields])
    titles = ("UDF: distance to the surface", f"its dilation: largest UDF of the k = {illustration.k} nearest points")
    draw_rows(
        paths, [Row(pictures, titles=titles)], scale=Scale(0, largest, DISTANCE_MAP, "distance, in the shape's unit")
    )


def draw_dilation_from_files(paths: Sequence[Path], illustration: Path, *, pixels: int = 1000) -> None:
    """Draw the figure from a file with an illustration, see :func:`draw_dilation`."""
    draw_dilation(paths, read_illustration(illustration), pixels=pixels)
