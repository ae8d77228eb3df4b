"""The page on which every figure is drawn: widths, type, colour maps, and the files it is written to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.atomic import atomic_file
from morphoskel.reporting.render import Image
from morphoskel.shapes import FloatArray, IntArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TEXT_WIDTH, COLUMN_WIDTH = 6.9, 3.3
"""Of a printed page of two columns, in inches."""

DISTANCE_MAP, RESIDUE_MAP, SIZE_MAP = "viridis", "cividis", "plasma"
"""Perceptually uniform colours of distances and radii, of residues, and of local feature sizes and weights."""

PART_COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")
"""Tol's bright scheme, which people with any colour vision can tell apart; parts beyond its end begin anew."""

STYLE: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "legend.frameon": False,
    "pdf.fonttype": 42,  # letters stay letters in the PDF
}
DOTS_PER_INCH = 300

BAR_SHARE, BAR_ASPECT = 0.75, 25.0
"""Height of a colour bar, as a share of the axes beside it and in its widths."""


@contextmanager
def figure_page(paths: Sequence[Path], width: float, height: float) -> Iterator[Figure]:
    """Open a figure to draw on; it is written when the block ends without an error.

    Parameters
    ----------
    paths
        Files to write, whole or not at all; the ending says how, ``.png`` or ``.pdf``.
    width, height
        Inches.
    """
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(width, height), layout="constrained")
        FigureCanvasAgg(figure)
        yield figure
        with ExitStack() as files:
            for path in paths:
                kind = path.suffix[1:]
                # The time of writing would make equal figures differ.
                metadata = {"CreationDate": None} if kind == "pdf" else {}
                partial = files.enter_context(atomic_file(path))
                figure.savefig(partial, dpi=DOTS_PER_INCH, format=kind, metadata=metadata)


def show(axes: Axes, picture: Image, title: str = "") -> None:
    """Put a rendered picture into axes, without frame or ticks."""
    axes.imshow(picture, interpolation="antialiased")
    axes.set(xticks=[], yticks=[], frame_on=False)
    axes.set_title(title, parse_math=False)  # names of files may hold dollars


def cropped(pictures: Sequence[Image], margin: int = 6) -> list[Image]:
    """Cut away what is white in all of several pictures of one size, but for a margin in pixels.

    They stay aligned with each other; where nothing is drawn at all they are returned as they are.
    """
    drawn = np.any([(picture < 1).any(axis=2) for picture in pictures], axis=0)
    if not drawn.any():
        return list(pictures)
    ranges = []
    for axis in (1, 0):
        used = np.flatnonzero(drawn.any(axis=axis))
        ranges.append(slice(max(int(used[0]) - margin, 0), int(used[-1]) + margin + 1))
    return [picture[ranges[0], ranges[1]] for picture in pictures]


def paint(values: FloatArray, low: float, high: float, colour_map: str) -> FloatArray:
    """Return the ``(N, 3)`` colours of ``(N,)`` values on a scale from `low` to `high`."""
    import matplotlib

    share = np.clip((np.asarray(values, dtype=np.float64) - low) / max(high - low, 1e-300), 0, 1)
    colours: FloatArray = np.asarray(matplotlib.colormaps[colour_map](share))[:, :3]
    return colours


def paint_parts(parts: IntArray) -> FloatArray:
    """Return the ``(N, 3)`` colours of parts, ``(N,)`` int64 numbers that begin at 0."""
    from matplotlib.colors import to_rgb

    palette: FloatArray = np.array([to_rgb(colour) for colour in PART_COLOURS])
    return palette[parts % len(palette)]


def add_scale(
    figure: Figure,
    axes: Axes | Sequence[Axes],
    low: float,
    high: float,
    colour_map: str,
    label: str,
    *,
    aspect: float = BAR_ASPECT,
) -> None:
    """Add a colour bar beside axes, `aspect` times as high as wide."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale = ScalarMappable(Normalize(low, high), colour_map)
    bar = figure.colorbar(scale, ax=axes, shrink=BAR_SHARE, pad=0.01, aspect=aspect)
    bar.set_label(label)
    bar.outline.set_visible(False)
