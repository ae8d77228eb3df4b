"""Figure: the way from a point cloud to its skeleton, one picture a stage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.reporting.figure_page import (
    DISTANCE_MAP,
    RESIDUE_MAP,
    TEXT_WIDTH,
    cropped,
    figure_page,
    paint,
    show,
)
from morphoskel.reporting.figures.section_view import SectionView, largest_distance, largest_residue, section_view
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.illustration_file import read_illustration
from morphoskel.reporting.render import Image

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = 4
GAP, TITLE_HEIGHT, NOTE_HEIGHT, TURN_HEIGHT, SCALES_HEIGHT = 0.3, 0.19, 0.3, 0.22, 0.5
"""Inches between columns, of a title, of the note below a picture, of the arrow between rows, and of the scales."""

CLOUD_SIZE = 0.0025
"""Radius of a point of the cloud, in sides of the picture."""

ARROW_COLOUR = "0.35"


@dataclass(frozen=True)
class _Panel:
    picture: Image
    title: str
    note: str


def draw_overview(paths: Sequence[Path], illustration: Illustration, *, pixels: int = 560) -> None:
    """Draw every stage from the cloud to the balls, in order, in two rows.

    Parameters
    ----------
    paths
        Files to write.
    illustration
        The shape.
    pixels
        Side of each picture.
    """
    farthest, largest = largest_distance(illustration), largest_residue(illustration)
    panels = _panels(illustration, section_view(illustration, pixels), farthest, largest)
    high, wide = panels[0].picture.shape[:2]
    width = (TEXT_WIDTH - (COLUMNS - 1) * GAP) / COLUMNS
    height = width * high / wide
    pitch = TITLE_HEIGHT + height + NOTE_HEIGHT + TURN_HEIGHT
    with figure_page(paths, TEXT_WIDTH, 2 * pitch - TURN_HEIGHT + SCALES_HEIGHT) as figure:
        figure.set_layout_engine("none")  # the arrows need to know where the pictures are
        top = figure.get_figheight()
        for index, panel in enumerate(panels):
            row, column = divmod(index, COLUMNS)
            left, bottom = column * (width + GAP), top - row * pitch - TITLE_HEIGHT - height
            _place(figure, panel, index + 1, (left, bottom, width, height))
            if column:
                middle = bottom + height / 2
                _add_arrow(figure, [(left - 0.85 * GAP, middle), (left - 0.15 * GAP, middle)])
        turn, end = top - pitch + 0.6 * TURN_HEIGHT, top - pitch
        first, last = width / 2, TEXT_WIDTH - width / 2
        _add_arrow(figure, [(last, turn + 0.5 * TURN_HEIGHT), (last, turn), (first, turn), (first, end)])
        _add_scales(figure, farthest, largest)


def draw_overview_from_files(paths: Sequence[Path], illustration: Path, *, pixels: int = 560) -> None:
    """Draw the figure from a file with an illustration, see :func:`draw_overview`."""
    draw_overview(paths, read_illustration(illustration), pixels=pixels)


def _panels(illustration: Illustration, view: SectionView, farthest: float, largest: float) -> list[_Panel]:
    cloud, surface, balls = view.canvas(), view.canvas(), view.canvas()
    cloud.add_points(illustration.cloud, view.by_depth(illustration.cloud), CLOUD_SIZE)
    surface.add_mesh(illustration.surface)
    skeleton = illustration.skeleton
    balls.add_balls(skeleton.points, skeleton.radii, paint(skeleton.radii, 0, farthest, DISTANCE_MAP))
    balls.add_veil(illustration.surface, 0.1)
    pictures = [
        cloud.image(),
        surface.image(),
        view.draw_inner(illustration, view.by_depth(illustration.inner), cut=False),
        view.draw_distances(illustration, illustration.udf, farthest),
        view.draw_distances(illustration, illustration.dilated, farthest),
        view.draw_residues(illustration, largest),
        view.draw_selected(illustration, farthest),
        balls.image(),
    ]
    texts = [
        ("point cloud", "points on the surface"),
        ("closed surface", "made watertight"),
        ("inner points", f"{illustration.inner_count:,} of\n{illustration.candidate_count:,} candidates"),
        ("UDF", "distance to the surface\n(half of the shape removed)"),
        ("dilation", f"largest UDF of the\nk = {illustration.k} nearest points"),
        ("residue", "dilation minus UDF"),
        ("skeletal points", f"the {len(skeleton):,} points of\nsmallest residue"),
        ("maximal balls", "radius: UDF"),
    ]
    return [_Panel(picture, *text) for picture, text in zip(cropped(pictures, margin=2), texts, strict=True)]


def _place(figure: Figure, panel: _Panel, number: int, rectangle: tuple[float, float, float, float]) -> None:
    """Put a panel at a place given in inches: left, bottom, width and height of its picture."""
    axes = figure.add_axes(_share(figure, *rectangle))
    show(axes, panel.picture)
    axes.set_title(f"{number}  {panel.title}", pad=3)
    axes.set_xlabel(panel.note, fontsize=7, labelpad=2)


def _add_arrow(figure: Figure, corners: Sequence[tuple[float, float]]) -> None:
    """Draw an arrow through corners, in inches from the lower left corner of the page."""
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.path import Path as Outline

    arrow = FancyArrowPatch(
        path=Outline(corners),
        transform=figure.dpi_scale_trans,
        arrowstyle="-|>",
        mutation_scale=7,
        color=ARROW_COLOUR,
        linewidth=0.9,
        joinstyle="miter",
        fill=False,
    )
    figure.add_artist(arrow)


def _add_scales(figure: Figure, farthest: float, largest: float) -> None:
    """Add the scales of distances and residues side by side at the foot of the page."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.ticker import MaxNLocator

    middle = TEXT_WIDTH / 2
    for start, high, colour_map, label in (
        (0.35, farthest, DISTANCE_MAP, "UDF and dilation, in the shape's unit"),
        (middle + 0.35, largest, RESIDUE_MAP, "residue, in the shape's unit"),
    ):
        axes = figure.add_axes(_share(figure, start, SCALES_HEIGHT - 0.14, middle - 0.7, 0.07))
        bar = figure.colorbar(
            ScalarMappable(Normalize(0, high), colour_map), cax=axes, orientation="horizontal", ticks=MaxNLocator(5)
        )
        bar.set_label(label, labelpad=1)
        bar.outline.set_visible(False)


def _share(
    figure: Figure, left: float, bottom: float, width: float, height: float
) -> tuple[float, float, float, float]:
    """Return a rectangle given in inches as shares of the page."""
    across, up = figure.get_size_inches()
    return float(left / across), float(bottom / up), float(width / across), float(height / up)
