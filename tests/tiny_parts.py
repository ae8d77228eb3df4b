"""Small clouds with parts, and settings, for quick tests of part segmentation."""

import numpy as np
import torch

from morphoskel.datasets.cloud_set import CloudSet, normalise
from morphoskel.learning.segmentation_phase import LabelledClouds
from morphoskel.networks.part_segmentation import PartSegmentationNetwork
from morphoskel.networks.segmentation_settings import SegmentationSettings

TINY = SegmentationSettings(
    before=(8, 8),
    after=(8,),
    cloud_features=16,
    point_transform_channels=(8, 8),
    point_transform_head=(8,),
    feature_transform_channels=(8,),
    feature_transform_head=(8, 8),
    head=(8, 8, 8),
    dropout=0.2,
    penalty=0.001,
    batch_size=4,
    epochs=2,
    learning_rate=1e-2,
    decay=0.5,
    decay_epochs=1,
    lowest_learning_rate=1e-5,
    know_category=True,
    restrict_to_category=True,
    training_input="all",
    training_points=None,
)

NAMES = ("ball", "stick")

PART_CLASSES = (0, 0, 1, 1, 1)


def tiny_parts(shapes=8, points=40, seed=0, repeated=0):
    """Return balls of two halves and sticks of three segments in turn; the last points of each repeat its first ones.

    The clouds are called ``s0``, ``s1``, ...
    """
    generator = np.random.default_rng(seed)
    distinct = points - repeated
    normalised, parts = [], []
    for shape in range(shapes):
        cloud = generator.normal(size=(distinct, 3))
        if shape % 2:
            of_points = 2 + np.arange(distinct) % 3
            cloud[:, 0] = of_points + generator.uniform(0.2, 0.8, size=distinct)
            cloud[:, 1:] *= 0.05
        else:
            of_points = np.arange(distinct) % 2
            cloud[:, 0] = (2 * of_points - 1) * (abs(cloud[:, 0]) + 0.2)
        normalised.append(normalise(cloud[np.arange(points) % distinct] * 3 + 5))
        parts.append(np.concatenate([of_points, np.full(repeated, -1)]))
    clouds, centres, scales = zip(*normalised, strict=True)
    return CloudSet(
        ids=np.array([f"s{number}" for number in range(shapes)]),
        labels=np.arange(shapes) % 2,
        class_names=np.array(NAMES),
        points=np.stack(clouds),
        centres=np.stack(centres),
        scales=np.array(scales),
        parts=np.stack(parts),
        part_classes=np.array(PART_CLASSES),
    )


def labelled(clouds, *masks):
    """Return the tensors of clouds of which the points in each of the masks are labelled, or else all of them."""
    masks = masks or (clouds.parts >= 0,)
    arrays = (clouds.points, clouds.labels, clouds.parts, np.stack(masks, axis=1))
    return LabelledClouds(*map(torch.from_numpy, arrays))


def every(step, clouds, start=0):
    """Return a mask of every few points of each cloud."""
    return np.broadcast_to(np.arange(clouds.parts.shape[1]) % step == start, clouds.parts.shape) & (clouds.parts >= 0)


def tiny_segmentation(settings=TINY, seed=0):
    """Return a network whose weights the seed decides, that transforms, and whose statistics are those of clouds."""
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        network = PartSegmentationNetwork(PART_CLASSES, NAMES, settings)
        for transform in (network.point_transform, network.feature_transform):
            torch.nn.init.normal_(transform.matrix.weight, std=0.1)
        clouds = tiny_parts()
        for _ in range(10):
            network(torch.from_numpy(clouds.points), torch.from_numpy(clouds.labels))
        return network.eval()
