"""Parameters of the L1-medial skeleton, with the defaults of the released program."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import get_args

from morphoskel.errors import ConfigError
from morphoskel.skeleton.ball_radii import RadiusKind


@dataclass(frozen=True)
class L1MedialSettings:
    """Parameters of :func:`morphoskel.skeleton.l1_medial.l1_medial`.

    All lengths are in units of the longest side of the cloud's bounding box, all angles in degrees. The released
    program contracts to a Gaussian mean (``average_power=2``, ``repulsion_power=1``); the energy of the paper, an L1
    median with a steeper repulsion, is ``average_power=1, repulsion_power=2``.

    Parameters
    ----------
    samples
        Points of the cloud that are contracted; at most half of the cloud.
    radius_factor
        First neighbourhood radius: this times the diagonal of the bounding box over the cube root of the number of
        points. The paper's text has 2.
    radius_growth
        Share by which the radius grows from stage to stage.
    largest_radius
        The last stage is the one after which the radius exceeds this.
    iterations
        Iterations a stage, at most.
    displacement
        A stage ends earlier once the samples move less than this on average.
    average_power
        2 for a Gaussian mean of the points in the neighbourhood, 1 for an L1 median; the weights are Gaussian times
        distance to the power of this minus 2.
    repulsion_power
        The repulsion between samples falls like the Gaussian over the distance to this power.
    least_repulsion, largest_repulsion
        Strength of the repulsion of the sample of least and of largest directionality.
    density_weights
        Whether points count less where the cloud is dense.
    explained_weight
        Factor on the weight of points that a branch explains already.
    directionality
        Samples are candidates for a branch from this directionality on, which is 1 on a line and 1/3 in a ball.
    directionality_neighbours
        Nearest samples from which the directionality is computed at the end of a stage.
    trace_neighbours
        Nearest samples among which the next point of a branch is looked for.
    trace_distance
        Longest step along a branch.
    turn_angle
        Largest turn from one step along a branch to the next.
    branch_samples
        A branch has at least this many samples, and as many more as the radius is a multiple of the first one.
    growth_distance
        Longest step when a branch grows at its end.
    growth_directionality
        Directionality from which on a sample can be added at the end of a branch.
    follow_distance, follow_angle
        Farthest that the bridge at the end of a branch is from the last sample on the branch, and largest angle
        between it and the heading there.
    bridge_angle
        The bridge is dropped if it is at a larger angle than this.
    merge_distance
        Ends of branches as close as this merge.
    join_angle
        Two ends are joined to one branch if their headings meet at more than this; 180 is straight on.
    clean_distance
        Samples as close as this to a branch are removed.
    duplicate_distance
        Samples as close as this are the same.
    spacing
        Distance of consecutive nodes of the finished curves.
    recentre
        Whether the nodes of the curves are moved to the centres of the sections of the cloud around them.
    keep_leftover
        Whether samples that ended on no branch become nodes, too.
    radius
        How the radii of the balls are measured, see :func:`morphoskel.skeleton.ball_radii.radii_of`. The radii that
        the released program stores are those of the neighbourhoods and tell nothing about the shape.

    Raises
    ------
    ConfigError
        If a value is not in its range.
    """

    samples: int = 1000
    radius_factor: float = 1.0
    radius_growth: float = 0.5
    largest_radius: float = 1.99
    iterations: int = 55
    displacement: float = 5e-4
    average_power: float = 2.0
    repulsion_power: float = 1.0
    least_repulsion: float = 0.15
    largest_repulsion: float = 0.35
    density_weights: bool = True
    explained_weight: float = 0.91
    directionality: float = 0.901
    directionality_neighbours: int = 6
    trace_neighbours: int = 12
    trace_distance: float = 0.4
    turn_angle: float = 25.0
    branch_samples: int = 6
    growth_distance: float = 0.15
    growth_directionality: float = 0.8
    follow_distance: float = 0.33
    follow_angle: float = 80.0
    bridge_angle: float = 101.0
    merge_distance: float = 0.08
    join_angle: float = 140.0
    clean_distance: float = 0.05
    duplicate_distance: float = 0.01
    spacing: float = 0.051
    recentre: bool = True
    keep_leftover: bool = True
    radius: RadiusKind = "nearest"

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            lowest, highest = LOWEST.get(field.name, 0.0), HIGHEST.get(field.name, LARGEST)
            if isinstance(value, (int, float)) and not lowest <= value <= highest:
                raise ConfigError(
                    f"L1-medial skeleton: {field.name} must be from {lowest:g} to {highest:g}, got {value}"
                )
        if self.largest_repulsion < self.least_repulsion:
            raise ConfigError(
                f"L1-medial skeleton: largest_repulsion ({self.largest_repulsion}) must not be below "
                f"least_repulsion ({self.least_repulsion})"
            )
        if self.radius not in get_args(RadiusKind):
            raise ConfigError(
                f"L1-medial skeleton: radius must be one of {', '.join(get_args(RadiusKind))}, got {self.radius!r}"
            )


LOWEST = {
    "samples": 2,
    "radius_factor": 1e-3,
    "radius_growth": 1e-3,
    "iterations": 1,
    "directionality_neighbours": 4,
    "trace_neighbours": 1,
    "branch_samples": 3,
    "spacing": 1e-4,
}
"""Smallest legal values other than 0."""

HIGHEST = {
    "average_power": 2.0,
    "explained_weight": 1.0,
    "directionality": 1.0,
    "growth_directionality": 1.0,
    "turn_angle": 180.0,
    "follow_angle": 180.0,
    "bridge_angle": 180.0,
    "join_angle": 180.0,
}
"""Largest legal values."""

LARGEST = 1e9
"""Largest legal value of the others; infinity is taken for a mistake."""
