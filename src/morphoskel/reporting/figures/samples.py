"""Points of one cloud as samplers choose them: one row a sampler, one column a number of points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.reporting.figure_page import SIZE_MAP, cropped, paint
from morphoskel.reporting.figures.panels import Row, Scale, draw_rows
from morphoskel.reporting.figures.shown_shapes import NOT_THERE, choose_shapes
from morphoskel.reporting.render import FROM_THE_FRONT, Canvas, Image, View
from morphoskel.reporting.sample_picture import nearness
from morphoskel.reporting.sampling_names import SAMPLER_NAMES
from morphoskel.sampling.choice import DRAWN, FIXED
from morphoskel.shapes import FloatArray

WANTED = ("airplane",)
FROM_ABOVE = replace(FROM_THE_FRONT, elevation=38.0, pixels=640)
"""Higher than usual, so that the wings of an airplane do not hide behind each other."""

CHOSEN_SIZE, POINT_SIZE = 0.0145, 0.006
"""Radius of a chosen point and of another, in sides of the picture."""

PLAIN_COLOUR = (0.27, 0.47, 0.67)
"""Of chosen points whose local feature size is unknown."""

FAINT, STRONG = 0.97, 0.8
"""Grey of a point of the cloud, the farthest from the viewer and the nearest."""


def draw_samples(
    paths: Sequence[Path],
    points: FloatArray,
    chosen: Mapping[str, Mapping[int, npt.NDArray[np.int32] | str]],
    sizes: FloatArray | None,
    *,
    view: View = FROM_ABOVE,
) -> None:
    """Draw a cloud in grey and the points chosen of it in colour, once for every sampler and number of points.

    Parameters
    ----------
    paths
        Files to write.
    points
        ``(N, 3)``, the cloud.
    chosen
        For each sampler's title and number of points wanted: ``(M,)`` int32, the points, which may repeat, or what to
        say in their place. A number that a sampler lacks is said to be missing.
    sizes
        ``(N,)``, local feature size of each point, shown as the colour of the chosen ones; ``None`` if unknown.
    view
        The camera.

    Raises
    ------
    InputError
        If there is no sampler.
    """
    counts = sorted({count for of_sampler in chosen.values() for count in of_sampler})
    colours, scale = np.tile(PLAIN_COLOUR, (len(points), 1)), None
    if sizes is not None:
        scale = Scale(0, float(sizes.max()), SIZE_MAP, "local feature size (radius of the cloud = 1)")
        colours = paint(sizes, scale.low, scale.high, scale.colour_map)
    panels = {name: [of_sampler.get(count, NOT_THERE) for count in counts] for name, of_sampler in chosen.items()}
    pictures = [
        _draw(points, which, colours, view) for row in panels.values() for which in row if not isinstance(which, str)
    ]
    drawn = iter(cropped(pictures))
    rows = [
        Row(
            [which if isinstance(which, str) else next(drawn) for which in row],
            name=name,
            titles=[f"{count} points" for count in counts] if number == 0 else (),
            notes=[_repeats(which) for which in row],
        )
        for number, (name, row) in enumerate(panels.items())
    ]
    draw_rows(paths, rows, scale=scale)


def _draw(points: FloatArray, chosen: npt.NDArray[np.int32], colours: FloatArray, view: View) -> Image:
    canvas = Canvas(view, [points.min(axis=0), points.max(axis=0)])
    grey = FAINT + (STRONG - FAINT) * nearness(points, view)
    canvas.add_points(points, np.repeat(grey[:, None], 3, axis=1), POINT_SIZE)
    # Other points that are nearer to the viewer would be specks on the chosen ones; the cloud hides nothing anyway.
    canvas.depth[:] = -np.inf
    distinct = np.unique(chosen)
    canvas.add_points(points[distinct], colours[distinct], CHOSEN_SIZE)
    return canvas.image()


def _repeats(chosen: npt.NDArray[np.int32] | str) -> str:
    """Return how many points are different ones, if not all are."""
    if isinstance(chosen, str):
        return ""
    distinct = len(np.unique(chosen))
    return "" if distinct == len(chosen) else f"{distinct} distinct"


def draw_samples_from_files(
    paths: Sequence[Path],
    clouds: Path,
    samples: Mapping[str, Path],
    priors: Path | None,
    *,
    wanted: Sequence[str] = WANTED,
    view: View = FROM_ABOVE,
) -> None:
    """Draw what samplers choose of one shape, by default an airplane.

    Of a sampler with noise the first draw is shown, and of a learned one its first training.

    Parameters
    ----------
    paths
        Files to write.
    clouds
        File of the split's clouds.
    samples
        For each sampler its folder of chosen points.
    priors
        File of the local feature sizes that are shown as colours; ``None`` for one colour.
    wanted
        See :func:`~morphoskel.reporting.figures.shown_shapes.choose_shapes`.
    view
        The camera.
    """
    from morphoskel.datasets.cloud_set import read_cloud_set
    from morphoskel.sampling.prior_set import read_prior_set

    shapes = read_cloud_set(clouds)
    (place,) = choose_shapes(shapes.ids.tolist(), shapes.categories.tolist(), wanted=wanted, count=1).values()
    sizes = read_prior_set(priors, shapes).distances[place].astype(np.float64) if priors else None
    if sizes is not None and not np.isfinite(sizes).all():
        sizes = None
    chosen = {SAMPLER_NAMES[name]: _chosen(folder, place) for name, folder in samples.items()}
    draw_samples(paths, shapes.points[place].astype(np.float64), chosen, sizes, view=view)


def _chosen(folder: Path, place: int) -> dict[int, npt.NDArray[np.int32] | str]:
    """Return the points that a sampler chose of one shape, by their number, as it is meant to choose."""
    from morphoskel.sampling.choose_for_split import read_choices

    found: dict[int, npt.NDArray[np.int32] | str] = {}
    for (_, number, kind), choice in read_choices(folder).items():
        if number == 0 and kind in (FIXED, DRAWN):
            indices = choice.indices[0, place]
            found[len(indices)] = "nothing chosen" if (indices < 0).any() else indices
    return found
