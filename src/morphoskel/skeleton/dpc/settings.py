"""The parameters of deep points consolidation."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal, get_args

from morphoskel.errors import ConfigError

DeepPointRadii = Literal["nearest", "mean_assigned", "deep_link"]
RepulsionDistance = Literal["euclidean", "ellipsoid"]

WHOLE_NUMBERS = {"samples": 4, "untested_steps": 0, "max_steps": 1, "iterations": 0}
"""The parameters that count something, with their least values."""
POSITIVE = {"surface_radius", "step", "stop_radius", "radius", "box"}
CHOICES = {"repulsion_distance": get_args(RepulsionDistance), "radii": get_args(DeepPointRadii)}


@dataclass(frozen=True)
class DeepPointsSettings:
    """How inner points sink, how they form a meso-skeleton, and which radii they get.

    The defaults are those of the released program where it states them. All lengths are in units of the mean distance
    from a sample to the nearest other sample; angles are in degrees. The paper is Wu et al., "Deep Points
    Consolidation", SIGGRAPH Asia 2015.

    Parameters
    ----------
    samples
        Surface samples, each with an inner point, chosen by farthest point sampling; ``None`` takes every point of the
        cloud. The released program takes 1000.
    smoothing_angle
        Difference of two normals at which they count little for each other when normals are smoothed; 0 leaves the
        normals as they are.
    surface_radius
        Samples so near are neighbours on the surface: they share their normals and speeds.
    step
        How far an inner point of speed 1 sinks at a time.
    stop_radius
        An inner point stops when another one is so near that came from another direction.
    stop_angle
        Least angle between two directions that are opposite fronts.
    cooling
        An inner point stops when its speed, the mean of its neighbours' speeds, is less.
    untested_steps
        Steps at the start during which nothing stops. The test at the start of a step cannot tell an opposite front
        from the other side of a sharp edge, so at depth 0 the samples beside an edge would be stopped at once, with a
        ball of radius 0. One step, for which the released program has a button, takes all of them off the surface. A
        later implementation makes as many as sink by one unit, which also gets points away from concave edges, but in
        thin parts, frequent in scanned and modelled shapes, lets the two sides pass through each other.
    max_steps
        Further steps. Points that still move then are given the depth of their neighbours. The default reaches 30
        units, more than the largest ball that 2000 samples can enclose: of area 4π r² each sample covers about 4
        square units, so that r is at most √(2000 / π) ≈ 25 units. With more samples it must grow like their root.
    iterations
        Times that the meso-skeleton is optimised. The released program leaves it to the user.
    radius
        Range of averaging and repulsion between inner points.
    box, box_growth
        The neighbours that repel an inner point lie in a box whose half sides are `radius` times ``box + box_growth *
        strength`` along axes of the given strength.
    contrast
        Power that sharpens the strengths of the three axes.
    repulsion_power
        Power of the reciprocal distance in the repulsion.
    repulsion
        Weight of the repulsion.
    least_strength
        Points are pushed along axes of greater strength only: two axes in a sheet, one in a curve.
    repulsion_distance
        Distance that damps the repulsion: ``euclidean``, the released program's default, or ``ellipsoid``, with each
        axis divided by its strength.
    radii
        ``nearest``: distance to the nearest point of the cloud; ``mean_assigned``: mean distance to the points of the
        cloud that are nearest to the centre; ``deep_link``: distance to the sample that the inner point came from,
        which the meso-skeleton makes larger than the inscribed ball.

    Raises
    ------
    ConfigError
        If a value is not legal.
    """

    samples: int | None = None
    smoothing_angle: float = 90.0
    surface_radius: float = 6.0
    step: float = 0.2
    stop_radius: float = 1.5
    stop_angle: float = 45.0
    cooling: float = 0.5
    untested_steps: int = 1
    max_steps: int = 150
    iterations: int = 3
    radius: float = 5.0
    box: float = 0.5
    box_growth: float = 3.0
    contrast: float = 8.0
    repulsion_power: float = 5.0
    repulsion: float = 0.5
    least_strength: float = 0.3
    repulsion_distance: RepulsionDistance = "euclidean"
    radii: DeepPointRadii = "nearest"

    def __post_init__(self) -> None:
        for field in fields(self):
            value, name = getattr(self, field.name), field.name
            if name in CHOICES:
                _check_choice(name, value)
            elif name in WHOLE_NUMBERS:
                _check_whole_number(name, value)
            else:
                _check_number(name, value)


def _check_choice(name: str, value: object) -> None:
    if value not in CHOICES[name]:
        raise ConfigError(f"{name}: expected one of {', '.join(CHOICES[name])}, got {value!r}")


def _check_whole_number(name: str, value: int | None) -> None:
    if value is None and name == "samples":
        return
    if not isinstance(value, int) or value < WHOLE_NUMBERS[name]:
        raise ConfigError(f"{name}: expected a whole number from {WHOLE_NUMBERS[name]}, got {value!r}")


def _check_number(name: str, value: float) -> None:
    if not (isinstance(value, int | float) and math.isfinite(value) and value >= 0):
        raise ConfigError(f"{name}: expected a finite number that is not negative, got {value!r}")
    if name in POSITIVE and value == 0:
        raise ConfigError(f"{name}: expected a number greater than 0")
    if name.endswith("_angle") and value > 180:
        raise ConfigError(f"{name}: expected an angle from 0 to 180 degrees, got {value!r}")
