"""Figure: solids of known skeletons, from the distance function to skeletons among random and regular candidates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import DISTANCE_MAP, cropped
from morphoskel.reporting.figures.panels import Row, Scale, draw_rows
from morphoskel.reporting.figures.section_view import largest_distance, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration


def draw_rationale(
    paths: Sequence[Path], solids: Mapping[str, tuple[Illustration, Illustration]], *, pixels: int = 700
) -> None:
    """Draw one row a solid: UDF and dilation, cut in two, and both skeletons, all on one scale.

    Parameters
    ----------
    paths
        Files to write.
    solids
        By name, illustrations of the solid with random and with regular candidates.
    pixels
        Side of each picture.

    Raises
    ------
    InputError
        If there is no solid, or the candidates of an illustration are not placed as they should be.
    """
    for name, pair in solids.items():
        modes = tuple(illustration.mode for illustration in pair)
        if modes != ("random", "grid"):
            raise InputError(f"{name}: expected an illustration of random and one of grid candidates, got {modes}")
    largest = max((largest_distance(*pair) for pair in solids.values()), default=0.0)
    rows: list[Row] = []
    for name, (random, grid) in solids.items():
        view = section_view(random, pixels)
        pictures = [
            *(view.draw_distances(random, field, largest) for field in (random.udf, random.dilated)),
            *(view.draw_selected(illustration, largest) for illustration in (random, grid)),
        ]
        titles = (
            ()
            if rows
            else ("UDF", f"dilation, k = {random.k}", "skeleton,\nrandom candidates", "skeleton,\ngrid of candidates")
        )
        rows.append(Row(cropped(pictures), name, titles))
    draw_rows(paths, rows, scale=Scale(0, largest, DISTANCE_MAP, "distance to the surface, in the solid's unit"))


def draw_rationale_from_files(
    paths: Sequence[Path], solids: Mapping[str, tuple[Path, Path]], *, pixels: int = 700
) -> None:
    """Draw the figure from two files with illustrations for each solid, see :func:`draw_rationale`."""
    read = {name: (read_illustration(random), read_illustration(grid)) for name, (random, grid) in solids.items()}
    draw_rationale(paths, read, pixels=pixels)
