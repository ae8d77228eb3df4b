"""One colour and one marker for each sampler, method, surface reconstruction and stage, the same in every chart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from morphoskel.errors import InputError
from morphoskel.reporting.segmentation_names import FULL

TOTAL = "total"
"""All stages of MS3D together."""

OPTICAL_SIZES = {"*": 1.5, "P": 1.25, "X": 1.25, "^": 1.1, "v": 1.1, "<": 1.1, ">": 1.1, "s": 0.9, "D": 0.85}
"""Factors that make markers look equally large."""


@dataclass(frozen=True)
class Mark:
    """How something is drawn in a chart.

    Parameters
    ----------
    colour
        Hexadecimal. Colours that meet in one chart differ for people with any colour vision.
    marker
        A marker of Matplotlib that can be filled, or not.
    emphasised
        Whether it is drawn larger and thicker, and under the others, so that none hides another.
    """

    colour: str
    marker: str
    emphasised: bool = False

    @property
    def order(self) -> float:
        """Place in the stack of lines and markers."""
        return 2.0 if self.emphasised else 3.0

    @property
    def size(self) -> float:
        """Of the marker, in points."""
        return (5.5 if self.emphasised else 4.0) * OPTICAL_SIZES.get(self.marker, 1.0)

    @property
    def line(self) -> dict[str, Any]:
        """Properties of the line through own values, for Matplotlib."""
        return {
            **{"color": self.colour, "marker": self.marker, "markersize": self.size},
            **{"linewidth": 2.4 if self.emphasised else 1.0, "markeredgecolor": "white", "markeredgewidth": 0.4},
            "zorder": self.order,
        }

    @property
    def dot(self) -> dict[str, Any]:
        """Properties of the marker of an own value."""
        return {**self.line, "linestyle": "none"}

    @property
    def hollow(self) -> dict[str, Any]:
        """Properties of the marker of a published value: a ring, in which an equal own value can still be seen."""
        return {
            **self.dot,
            **{"markerfacecolor": "white", "markeredgecolor": self.colour, "markeredgewidth": 0.9},
            **{"markersize": 1.35 * self.size, "zorder": self.order - 0.2},
        }


MARKS = {
    **{"random": Mark("#aaaaaa", "X"), "fps": Mark("#332288", "s"), "lfs": Mark("#33bbee", "^")},
    **{"snet": Mark("#8877cc", "v"), "samplenet": Mark("#225555", "<"), "metasampler": Mark("#44aa99", ">")},
    **{"skeleton_aware": Mark("#000000", "P"), "uniform": Mark("#994455", "h"), "shuffled": Mark("#6699cc", "*")},
    **{"ms3d": Mark("#d55e00", "o", emphasised=True), "ms3d_coverage": Mark("#882255", "^")},
    **{"dpc": Mark("#004488", "D"), "l1_medial": Mark("#ccbb66", "p")},
    **{"point2skeleton": Mark("#000000", "s"), "coverage_axis": Mark("#56b4e9", "v")},
    # Each surface stands for MS3D on it, and that on Poisson surfaces is the one of all other charts.
    **{"poisson": Mark("#d55e00", "o", emphasised=True), "repaired_poisson": Mark("#aaaaaa", "D")},
    **{"ball_pivoting": Mark("#332288", "v"), "alpha_shape": Mark("#6699cc", "^"), "ponq": Mark("#882255", "P")},
    **{"occupancy": Mark("#004488", "s"), "udf": Mark("#66ccee", "^"), "dilation": Mark("#ccbb66", "D")},
    **{"reconstruct": Mark("#bbbbbb", "v"), "watertight": Mark("#777777", "X")},
    **{"select_skeleton": Mark("#000000", "P"), "cover_skeleton": Mark("#882255", "p")},
    **{TOTAL: Mark("#d55e00", "o", emphasised=True), FULL: Mark("#000000", "d")},
}
"""By the names of the configuration, and :data:`TOTAL`. The colours are Tol's, but for the emphasised ones."""


def mark_of(name: str) -> Mark:
    """Return how a sampler, method, surface reconstruction or stage is drawn.

    Raises
    ------
    InputError
        If it has no mark.
    """
    if name not in MARKS:
        raise InputError(f"charts have no mark for {name!r}; known are {', '.join(MARKS)} (add it to figures/marks.py)")
    return MARKS[name]
