"""Whole files of networks, with the smallest sensible sizes and random weights."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import torch
from torch import nn

from fuzz.shape_seeds import written


def classifier_files(folder: Path) -> list[bytes]:
    """Return a classifier without weights, which is refused at the very end: with them it has 14 MB."""
    from tiny_classifier import TINY

    from morphoskel.networks.network_file import write_network

    values: dict[str, Any] = {"settings": TINY.as_mapping(), "class_names": ["ball", "line"]}
    return written(folder / "seed.pt", lambda path: write_network(nn.Identity(), path, **values))


def generator_files(folder: Path) -> list[bytes]:
    """Return a generator of points."""
    from tiny_generator import TINY

    from morphoskel.networks.point_generator import PointGenerator, save_generator

    torch.manual_seed(0)
    network = PointGenerator(4, TINY)
    return written(folder / "seed.pt", lambda path: save_generator(network, path))


def sampler_files(folder: Path) -> list[bytes]:
    """Return a skeleton-aware sampler."""
    from tiny_skeleton_aware import TINY_SAMPLER

    from morphoskel.networks.skeleton_sampler import SkeletonSampler, save_skeleton_sampler

    torch.manual_seed(0)
    network = SkeletonSampler(4, TINY_SAMPLER)
    return written(folder / "seed.pt", lambda path: save_skeleton_sampler(network, path))


def skeleton_aware_files(folder: Path) -> list[bytes]:
    """Return a network that predicts skeletons for sampling."""
    from tiny_skeleton_aware import TINY_SKELETON

    from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork, save_skeleton_aware

    torch.manual_seed(0)
    network = SkeletonAwareNetwork(TINY_SKELETON)
    return written(folder / "seed.pt", lambda path: save_skeleton_aware(network, path))


def segmentation_files(folder: Path) -> list[bytes]:
    """Return a network that finds parts."""
    from tiny_parts import tiny_segmentation

    from morphoskel.networks.part_segmentation import save_segmentation

    return written(folder / "seed.pt", lambda path: save_segmentation(tiny_segmentation(), path))


def point2skeleton_files(folder: Path) -> list[bytes]:
    """Return a Point2Skeleton network."""
    from tiny_point2skeleton import TINY

    from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork, save_network

    torch.manual_seed(0)
    network = Point2SkeletonNetwork(TINY)
    return written(folder / "seed.pt", lambda path: save_network(network, path))
