"""Settings and clouds for quick tests of the classifier."""

import torch

from morphoskel.networks.classifier_settings import ClassifierSettings

TINY = ClassifierSettings(
    dropped_points=0.5,
    drop_style="remove",
    lowest_scale=0.8,
    highest_scale=1.25,
    shift=0.1,
    feature_dropout=0.4,
    penalty=0.001,
    batch_size=4,
    epochs=2,
    learning_rate=1e-3,
    weight_decay=1e-4,
    decay=0.7,
    decay_epochs=1,
)

NAMES = ("ball", "line")


def balls_and_lines(shapes, points=40, seed=0):
    """Return clouds of two classes that differ by their extents, and their labels."""
    generator = torch.Generator().manual_seed(seed)
    labels = torch.arange(shapes) % 2
    extents = torch.tensor([[0.5, 0.5, 0.5], [0.9, 0.05, 0.05]])[labels]
    return torch.randn(shapes, points, 3, generator=generator) * extents[:, None] / 2, labels
