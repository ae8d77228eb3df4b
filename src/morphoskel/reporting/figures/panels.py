"""Rows of pictures with names, titles and notes, and words where there is no picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.reporting.figure_page import BAR_ASPECT, BAR_SHARE, TEXT_WIDTH, add_scale, cropped, figure_page
from morphoskel.reporting.render import Image

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SCALE_WIDTH, NAME_WIDTH, LEVEL_NAME_WIDTH = 0.62, 0.2, 0.64
"""Inches of a colour bar with its numbers and label, and of the names of the rows, upwards and level."""

LEVEL_LETTERS = 9
"""Of a line of a name that is written level, unless a word is longer."""

WIDEST_BAR = 0.13
"""Inches of a colour bar, however high it is."""

LINE_HEIGHT, ROW_GAP = 0.15, 0.06
"""Inches of a line of a title or note, and between rows."""


@dataclass(frozen=True)
class Scale:
    """A colour bar.

    Parameters
    ----------
    low, high
        Its ends.
    colour_map
        Name of a map of Matplotlib.
    label
        What it shows, and the unit.
    """

    low: float
    high: float
    colour_map: str
    label: str


@dataclass(frozen=True)
class Row:
    """Panels side by side.

    Parameters
    ----------
    panels
        Pictures, or what to say where there is none.
    name
        Written at the left.
    titles, notes
        Above and below the panels; none, or one a panel.
    scale
        A colour bar at the right, of this row alone.
    """

    panels: Sequence[Image | str]
    name: str = ""
    titles: Sequence[str] = ()
    notes: Sequence[str] = ()
    scale: Scale | None = None


def draw_rows(
    paths: Sequence[Path],
    rows: Sequence[Row],
    *,
    scale: Scale | None = None,
    width: float = TEXT_WIDTH,
    flattest: float = 0.3,
    tallest: float = 1.15,
    level_names: bool = False,
) -> None:
    """Draw rows of panels below each other.

    All panels of a row are of one size, so that their titles stand in a line. A picture fills its panel in one
    direction, which keeps pictures of one size at one scale.

    Parameters
    ----------
    paths
        Files to write.
    rows
        From top to bottom; those with fewer panels are empty at the right.
    scale
        A colour bar of all rows.
    width
        Inches.
    flattest, tallest
        Bounds on the height of a panel, in widths; between them it is that of the tallest picture of the row.
    level_names
        Write the names of the rows level and in several lines, as suits long ones; else upwards.

    Raises
    ------
    InputError
        If there is no panel.
    """
    columns = max((len(row.panels) for row in rows), default=0)
    if columns == 0:
        raise InputError("expected at least one shape to draw; the run has none for this figure")
    has_scale = scale is not None or any(row.scale for row in rows)
    name_width = LEVEL_NAME_WIDTH if level_names else NAME_WIDTH
    room = width - (SCALE_WIDTH if has_scale else 0) - (name_width if any(row.name for row in rows) else 0)
    ratios = [min(max([flattest, *_ratios(row)]), tallest) for row in rows]
    heights = [ratio * room / columns for ratio in ratios]
    text = sum(LINE_HEIGHT * (_lines(row.titles) + _lines(row.notes)) + ROW_GAP for row in rows)
    with figure_page(paths, width, sum(heights) + text) as figure:
        figure.set_layout_engine("constrained", w_pad=0.02, h_pad=0.02, wspace=0.02, hspace=0.0)
        grid = figure.subplots(len(rows), columns, squeeze=False, gridspec_kw={"height_ratios": heights})
        for row, ratio, of_row in zip(rows, ratios, grid, strict=True):
            _draw_row(row, list(of_row), ratio, level_names)
        if scale:
            # Beside many rows a bar of the usual shape would be too wide.
            _add(scale, list(grid.flat), max(BAR_ASPECT, BAR_SHARE * sum(heights) / WIDEST_BAR))


def crop_alike(panels: Sequence[Image | str]) -> list[Image | str]:
    """Crop the pictures among panels, see :func:`~morphoskel.reporting.figure_page.cropped`; words stay in place."""
    pictures = iter(cropped([panel for panel in panels if not isinstance(panel, str)]))
    return [panel if isinstance(panel, str) else next(pictures) for panel in panels]


def _draw_row(row: Row, of_row: Sequence[Axes], ratio: float, level_name: bool) -> None:
    for axes in of_row:
        # In the middle of too wide a place, axes would mislead the layout about the room for the name of the row.
        axes.set(xticks=[], yticks=[], frame_on=False, anchor="W")
    if level_name:
        name = "\n".join(wrap(row.name, LEVEL_LETTERS, break_long_words=False))
        of_row[0].set_ylabel(name, rotation="horizontal", ha="right", va="center", parse_math=False)
    else:
        of_row[0].set_ylabel(row.name, parse_math=False)
    for axes, panel in zip(of_row, row.panels, strict=False):
        _fill(axes, panel, ratio)
    for axes, title in zip(of_row, row.titles, strict=False):
        axes.set_title(title, pad=2, parse_math=False)  # names of files may hold dollars
    for axes, note in zip(of_row, row.notes, strict=False):
        axes.set_xlabel(note, fontsize=7, labelpad=1, parse_math=False)
    if row.scale:
        _add(row.scale, of_row)


def _add(scale: Scale, axes: Sequence[Axes], aspect: float = BAR_ASPECT) -> None:
    figure = axes[0].get_figure(root=True)
    if figure is not None:
        add_scale(figure, axes, scale.low, scale.high, scale.colour_map, scale.label, aspect=aspect)


def _fill(axes: Axes, panel: Image | str, ratio: float) -> None:
    """Put a picture or words into axes that are `ratio` times as high as wide."""
    axes.set_box_aspect(ratio)
    if isinstance(panel, str):
        axes.text(0.5, 0.5, panel, ha="center", va="center", fontsize=7, transform=axes.transAxes, parse_math=False)
        return
    high, wide = panel.shape[:2]
    axes.imshow(panel, interpolation="antialiased", aspect="auto")
    across = max(wide, high / ratio)
    middle, half = (wide - 1) / 2, across / 2
    axes.set_xlim(middle - half, middle + half)
    middle, half = (high - 1) / 2, across * ratio / 2
    axes.set_ylim(middle + half, middle - half)


def _ratios(row: Row) -> list[float]:
    return [panel.shape[0] / panel.shape[1] for panel in row.panels if not isinstance(panel, str)]


def _lines(texts: Sequence[str]) -> int:
    return max((text.count("\n") + 1 for text in texts if text), default=0)
