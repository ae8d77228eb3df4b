"""Call a skeleton method by its name."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from morphoskel.errors import ConfigError, InputError
from morphoskel.shapes import FloatArray, Mesh, PointCloud, Skeleton
from morphoskel.volume import Candidates

if TYPE_CHECKING:
    from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork

HOW_TO_TRAIN = (
    "`morphoskel run train_point2skeleton dataset=NAME dataset.root=FOLDER run=RUN` trains one and writes it to "
    "results/RUN/networks/NAME/point2skeleton/network.pt"
)


def skeleton_inside(
    method: str,
    closed: Mesh,
    candidates: Candidates,
    surface_points: FloatArray | None,
    *,
    k: int,
    points: int,
    settings: Mapping[str, Any],
    threads: int = 1,
) -> Skeleton:
    """Run a method that chooses balls among the points inside a closed surface.

    Parameters
    ----------
    method
        One of :data:`~morphoskel.methods.SURFACE_METHODS`.
    closed
        Closed surface.
    candidates
        Points in its bounding box.
    surface_points
        ``(P, 3)`` float64, points of the true surface, which the balls have to cover; ``ms3d`` needs none.
    k
        Size of the structuring element; ``coverage_axis`` has none.
    points
        Balls wanted.
    settings
        The method's other settings, see its function.
    threads
        Threads of each stage. Does not change the result.

    Returns
    -------
    Skeleton
        In the order of the method.

    Raises
    ------
    InputError
        If the method needs surface points and there are none.
    ShapeError
        If the surface is not closed, or no ball can be chosen.
    """
    from morphoskel.morphology import dilation
    from morphoskel.morphology.residue import residue
    from morphoskel.skeleton import ms3d
    from morphoskel.skeleton.coverage import coverage_skeleton, typical_radius
    from morphoskel.skeleton.coverage_axis import coverage_axis
    from morphoskel.volume import SurfaceDistance, occupancy

    if method == "ms3d":
        return ms3d(closed, candidates, k=k, points=points, threads=threads)
    if surface_points is None:
        raise InputError(f"{method}: needs points of the surface to cover; got none")
    inner = occupancy(closed, candidates, threads=threads).inner_points(threads=threads)
    if method == "coverage_axis":
        return coverage_axis(surface_points, inner.astype(np.float64), points=points, **settings)
    udf = SurfaceDistance(closed)(inner, threads=threads)
    residues = residue(udf, dilation(inner, udf, k, threads=threads))
    return coverage_skeleton(
        inner,
        udf,
        residues,
        surface_points,
        points=points,
        element_radius=typical_radius(candidates, k),
        threads=threads,
        **settings,
    )


def skeleton_of_cloud(
    method: str,
    cloud: PointCloud,
    generator: np.random.Generator,
    *,
    settings: Mapping[str, Any],
    network: Path | str | None = None,
) -> Skeleton:
    """Run a method that reads the cloud alone.

    Parameters
    ----------
    method
        One of :data:`~morphoskel.methods.CLOUD_METHODS`.
    cloud
        Points on the surface.
    generator
        Source of randomness of ``l1_medial``; the others draw nothing.
    settings
        The method's settings, see its function or its class of settings.
    network
        File with a trained network, for ``point2skeleton``.

    Returns
    -------
    Skeleton
        In the order of the method.

    Raises
    ------
    InputError, ConfigError
        If a setting is not legal or the network cannot be read.
    ShapeError
        If the method finds no skeleton.
    """
    if method == "l1_medial":
        from morphoskel.skeleton.l1_medial import L1MedialSettings, l1_medial

        return l1_medial(cloud, generator, L1MedialSettings(**settings))
    if method == "dpc":
        from morphoskel.skeleton.dpc import DeepPointsSettings, deep_points

        return deep_points(cloud, DeepPointsSettings(**settings))
    from morphoskel.networks.point2skeleton_network import load_point2skeleton

    return _predict(cloud, load_point2skeleton(network_file(network)), settings)


def _predict(cloud: PointCloud, network: Point2SkeletonNetwork, settings: Mapping[str, Any]) -> Skeleton:
    import torch

    from morphoskel.skeleton.point2skeleton import point2skeleton

    before = torch.get_num_threads()
    torch.set_num_threads(1)  # as in the workflow; more threads add up in another order, which shows in the last bits
    try:
        return point2skeleton(cloud, network, **settings)
    finally:
        torch.set_num_threads(before)


def setting_names(method: str) -> tuple[str, ...]:
    """Return the names of a method's settings, beside the arguments that several methods share."""
    if method == "l1_medial":
        from morphoskel.skeleton.l1_medial.settings import L1MedialSettings

        return tuple(field.name for field in dataclasses.fields(L1MedialSettings))
    if method == "dpc":
        from morphoskel.skeleton.dpc.settings import DeepPointsSettings

        return tuple(field.name for field in dataclasses.fields(DeepPointsSettings))
    return {
        "ms3d": (),
        "ms3d_coverage": ("nominees", "touch"),
        "coverage_axis": ("offset", "penalty", "candidate_limit", "stop_when_covered"),
        "point2skeleton": ("refine_radii",),
    }[method]


def check_settings(method: str, settings: Mapping[str, Any]) -> None:
    """Refuse settings that the method does not have.

    Raises
    ------
    ConfigError
        Naming the legal ones.
    """
    legal = setting_names(method)
    unknown = [name for name in settings if name not in legal]
    if unknown:
        raise ConfigError(
            f"settings: {method} has no setting {', '.join(map(repr, unknown))}; "
            f"legal: {', '.join(legal) or 'none beside the arguments k and points'}"
        )


def check_network(method: str, network: Path | str | None) -> None:
    """Refuse a method without the network that it needs, or with one that it does not need.

    Raises
    ------
    ConfigError, InputError
        Saying how to train one.
    """
    if method == "point2skeleton":
        network_file(network)
    elif network is not None:
        raise ConfigError(f"network: {method} has none; leave it out, or choose the method point2skeleton")


def network_file(network: Path | str | None) -> Path:
    """Return the file of a trained network.

    Raises
    ------
    ConfigError
        If none is named.
    InputError
        If there is no such file.
    """
    if network is None:
        raise ConfigError(f"network: point2skeleton needs the file of a trained network; {HOW_TO_TRAIN}")
    if not Path(network).is_file():
        raise InputError(f"{network}: no such file; point2skeleton needs the file of a trained network. {HOW_TO_TRAIN}")
    return Path(network)
