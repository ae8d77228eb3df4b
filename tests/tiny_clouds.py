"""Small clouds, priors and classifiers, shared by the tests of the samplers."""

import dataclasses

import numpy as np
import torch
from tiny_classifier import NAMES, TINY, balls_and_lines

from morphoskel.datasets.cloud_set import CloudSet, normalise
from morphoskel.networks.pointnet_classifier import PointNetClassifier
from morphoskel.sampling.prior_set import PriorSet


def tiny_clouds(shapes=8, points=40, seed=0):
    """Return balls and lines in turn, called ``s0``, ``s1``, ..."""
    clouds, labels = balls_and_lines(shapes, points, seed)
    normalised = [normalise(cloud.double().numpy() * 3 + 5) for cloud in clouds]
    return CloudSet(
        ids=np.array([f"s{number}" for number in range(shapes)]),
        labels=labels.numpy(),
        class_names=np.array(NAMES),
        points=np.stack([points for points, _, _ in normalised]),
        centres=np.stack([centre for _, centre, _ in normalised]),
        scales=np.array([scale for _, _, scale in normalised]),
    )


def tiny_priors(clouds, failed=()):
    """Return distances to the centroid as local feature sizes; the shapes at the positions `failed` have none."""
    distances = np.linalg.norm(clouds.points, axis=2)
    distances[list(failed)] = np.nan
    reasons = ["inner: no inside" if number in failed else "" for number in range(len(clouds))]
    return PriorSet(clouds.ids, distances, np.array(reasons))


def select(record, positions):
    """Return the shapes at `positions`, in this order, of clouds or of priors."""
    of_shapes = {
        field.name: getattr(record, field.name)[positions]
        for field in dataclasses.fields(record)
        if field.name not in ("class_names", "part_classes") and getattr(record, field.name) is not None
    }
    return dataclasses.replace(record, **of_shapes)


def seeded(network, *arguments, seed=0):
    """Return a network with weights that the seed decides, in evaluation mode."""
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        return network(*arguments).eval()


def tiny_classifier(seed=0, names=NAMES):
    """Return an untrained classifier of balls and lines."""
    classifier = seeded(PointNetClassifier, len(names), TINY, seed=seed)
    classifier.class_names = tuple(names)
    return classifier


def same_weights(path, other):
    """Tell whether two files of networks hold the same weights, bit by bit."""
    first, second = (torch.load(file, weights_only=True)["weights"] for file in (path, other))
    return first.keys() == second.keys() and all(torch.equal(first[name], second[name]) for name in first)
