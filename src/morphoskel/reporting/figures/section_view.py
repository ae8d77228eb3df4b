"""Pictures of an illustrated shape, seen along its shorter horizontal side, whole or cut in two."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.reporting.figure_page import DISTANCE_MAP, RESIDUE_MAP, paint
from morphoskel.reporting.illustration import Illustration
from morphoskel.reporting.render import Canvas, Image, View
from morphoskel.shapes import FloatArray

TURN, ELEVATION = 25.0, 15.0
"""Degrees by which the camera is turned away from the shorter side, and lifted."""

TOUCH = 0.62
"""Radius of an inner point, in mean distances of neighbours: a little more than half of it closes most gaps."""

SELECTED_SIZE = 0.008
"""Radius of a point of the skeleton, in sides of the picture."""

NEAR_COLOUR, FAR_COLOUR = np.array([0.05, 0.32, 0.62]), np.array([0.62, 0.82, 0.97])
"""Of points that have no value to show; they turn paler with their distance from the camera."""

SHOWN_RESIDUES = 0.98
"""Share of the inner points whose residue the scale tells apart; the few above have its last colour."""


@dataclass(frozen=True, eq=False)
class SectionView:
    """A camera, and the plane that cuts a shape in two; the half nearer to the camera can be left out.

    Parameters
    ----------
    view
        The camera.
    bounds
        ``(2, 3)``, the box of the shape, which every picture covers.
    axis
        Coordinate axis across the plane.
    place
        Coordinate of the plane.
    """

    view: View
    bounds: FloatArray
    axis: int
    place: float

    def canvas(self) -> Canvas:
        """Return an empty picture that covers the box."""
        return Canvas(self.view, self.bounds)

    def behind(self, points: npt.NDArray[np.floating]) -> npt.NDArray[np.bool_]:
        """Return which of points ``(N, 3)`` lie in the half that stays, ``(N,)``."""
        behind: npt.NDArray[np.bool_] = points[:, self.axis] <= self.place
        return behind

    def draw_inner(self, illustration: Illustration, colours: npt.ArrayLike, *, cut: bool = True) -> Image:
        """Draw inner points as balls that touch; `colours` are ``(M, 3)`` or ``(3,)``; the far half alone if `cut`."""
        shown = self.behind(illustration.inner) if cut else np.ones(len(illustration.inner), dtype=np.bool_)
        colours = np.broadcast_to(np.asarray(colours, dtype=np.float64), (len(shown), 3))[shown]
        canvas = self.canvas()
        canvas.add_balls(illustration.inner[shown], TOUCH * illustration.spacing, colours)
        return canvas.image()

    def by_depth(self, points: npt.NDArray[np.floating]) -> FloatArray:
        """Return the ``(N, 3)`` colours of points ``(N, 3)`` that have no value to show."""
        towards = self.view.axes()[2]
        depth = (points - self.bounds.mean(axis=0)) @ towards
        reach = float((self.bounds[1] - self.bounds[0]) / 2 @ np.abs(towards))
        share = np.clip((depth / reach + 1) / 2, 0, 1)[:, None]
        colours: FloatArray = share * NEAR_COLOUR + (1 - share) * FAR_COLOUR
        return colours

    def draw_distances(self, illustration: Illustration, distances: npt.NDArray[np.float32], largest: float) -> Image:
        """Draw the far half of the inner points, coloured by distances ``(M,)`` on a scale from 0 to `largest`."""
        return self.draw_inner(illustration, paint(distances.astype(np.float64), 0, largest, DISTANCE_MAP))

    def draw_residues(self, illustration: Illustration, largest: float) -> Image:
        """Draw the far half of the inner points, coloured by residue on a scale from 0 to `largest`."""
        return self.draw_inner(illustration, paint(illustration.residues.astype(np.float64), 0, largest, RESIDUE_MAP))

    def draw_selected(self, illustration: Illustration, largest: float) -> Image:
        """Draw the points of the skeleton, coloured by UDF on a scale from 0 to `largest`, under the surface."""
        skeleton, canvas = illustration.skeleton, self.canvas()
        canvas.add_points(skeleton.points, paint(skeleton.radii, 0, largest, DISTANCE_MAP), SELECTED_SIZE)
        canvas.add_veil(illustration.surface, 0.1)
        return canvas.image()


def section_view(illustration: Illustration, pixels: int) -> SectionView:
    """Return a view along the shorter horizontal side, with y up, and a cut through the centre of the largest ball."""
    bounds = np.stack(illustration.surface.bounds)
    across, _, along = bounds[1] - bounds[0]
    axis, azimuth = (0, 90.0 - TURN) if across <= along else (2, TURN)
    thickest = illustration.inner[illustration.udf.argmax()]
    return SectionView(View(azimuth, ELEVATION, pixels), bounds, axis, float(thickest[axis]))


def largest_distance(*illustrations: Illustration) -> float:
    """Return the largest UDF of all inner points kept, the end of the scale of distances."""
    return max(float(illustration.udf.max()) for illustration in illustrations)


def largest_residue(illustration: Illustration) -> float:
    """Return the end of the scale of residues."""
    return float(np.quantile(illustration.residues, SHOWN_RESIDUES))
