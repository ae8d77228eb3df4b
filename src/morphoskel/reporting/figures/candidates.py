"""Figure: skeletons from few and from many candidates, and the distributions of the residues behind them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import DISTANCE_MAP, TEXT_WIDTH, add_scale, cropped, figure_page, show
from morphoskel.reporting.figures.section_view import largest_distance, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration
from morphoskel.shapes import FloatArray, IntArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SELECTED_COLOUR, ALL_COLOUR = "#4477aa", "#bb5566"

ZERO_PLACE = (-4.0, -2.0)
"""Where the bin of the local maxima is drawn, beside the others, which begin at 0 and are 1 wide."""

SCALE_WIDTH, CHART_HEIGHT = 0.75, 1.7
"""Inches of the colour bar, and of the charts with their labels."""


def draw_candidates(paths: Sequence[Path], few: Illustration, many: Illustration, *, pixels: int = 1000) -> None:
    """Draw two skeletons of one shape above the distributions of the residues, on one scale.

    Parameters
    ----------
    paths
        Files to write.
    few, many
        The shape with fewer and with more candidates.
    pixels
        Side of each picture.

    Raises
    ------
    InputError
        If the illustrations are of different shapes, so that their residues are counted in different bins.
    """
    both = (few, many)
    if few.name != many.name or not np.allclose(few.residue_edges, many.residue_edges, rtol=1e-6):
        raise InputError(f"expected two illustrations of one shape and surface, got {few.name} and {many.name}")
    view, largest = section_view(many, pixels), largest_distance(*both)
    pictures = cropped([view.draw_selected(illustration, largest) for illustration in both])
    high, wide = pictures[0].shape[:2]
    height = (TEXT_WIDTH - SCALE_WIDTH) / 2 * high / wide
    with figure_page(paths, TEXT_WIDTH, height + CHART_HEIGHT + 0.25) as figure:
        above, below = figure.subplots(2, 2, gridspec_kw={"height_ratios": [height, CHART_HEIGHT]})
        for axes, picture, illustration in zip(above, pictures, both, strict=True):
            show(axes, picture, f"{illustration.candidate_count:,} candidates, {illustration.inner_count:,} inside")
        add_scale(figure, list(above), 0, largest, DISTANCE_MAP, "UDF, in the shape's unit")
        _draw_distributions(below, both)


def draw_candidates_from_files(paths: Sequence[Path], few: Path, many: Path, *, pixels: int = 1000) -> None:
    """Draw the figure from two files with illustrations, see :func:`draw_candidates`."""
    draw_candidates(paths, read_illustration(few), read_illustration(many), pixels=pixels)


def shares_of_bins(illustration: Illustration) -> tuple[FloatArray, FloatArray]:
    """Return the percentages of the points selected and of all inner points whose residue is in each bin, ``(B,)``."""
    residues = illustration.residues[illustration.selected]
    selected: IntArray = np.histogram(residues, illustration.residue_edges)[0]
    return 100 * selected / selected.sum(), 100 * illustration.residue_counts / illustration.inner_count


def _draw_distributions(charts: Sequence[Axes], both: Sequence[Illustration]) -> None:
    """Draw a chart of each illustration with equal axes: percentages against bins.

    The bins are equal in logarithm, so the first, which holds 0, stands apart.
    """
    shares = [shares_of_bins(illustration) for illustration in both]
    used = np.flatnonzero(np.any([share > 0 for pair in shares for share in pair], axis=0)[1:]) + 1
    first, last = (int(used[0]), int(used[-1]) + 1) if len(used) else (1, 2)
    places = np.arange(last - first + 1)
    top = max(float(share.max()) for pair in shares for share in pair)
    for axes, (selected, everything) in zip(charts, shares, strict=True):
        for bins, edges in ((slice(0, 1), ZERO_PLACE), (slice(first, last), places)):
            axes.stairs(selected[bins], edges, fill=True, color=SELECTED_COLOUR, label="points selected")
            axes.stairs(everything[bins], edges, color=ALL_COLOUR, linewidth=1.2, label="all inner points")
        axes.set(xlim=(ZERO_PLACE[0] - 0.5, places[-1] + 0.5), ylim=(0, 1.05 * top))
        axes.set_xlabel("residue, in longest sides of the box")
        _mark_decades(axes, both[0].residue_edges, first, last)
    handles, labels = charts[0].get_legend_handles_labels()
    charts[0].legend(handles[:2], labels[:2], loc="best")
    charts[0].set_ylabel("share of the points, %")
    charts[1].tick_params(labelleft=False)


def _mark_decades(axes: Axes, edges: FloatArray, first: int, last: int) -> None:
    """Label the first bin, and the powers of ten, in the largest of the edges, among those that are drawn."""
    ticks, labels = [sum(ZERO_PLACE) / 2], ["0"]
    powers = np.log10(edges[first : last + 1] / edges[-1])
    for place, power in enumerate(powers):
        if abs(power - round(power)) < 1e-6:
            ticks.append(float(place))
            labels.append(f"$10^{{{round(power)}}}$")
    axes.set_xticks(ticks, labels)
