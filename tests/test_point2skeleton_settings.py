import pytest

from morphoskel.errors import ConfigError
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings


def test_the_defaults_are_the_published_values():
    settings = Point2SkeletonSettings()
    assert settings.centroids == (1024, 768, 512, 512)
    assert (settings.pretrain_epochs, settings.skeleton_epochs, settings.link_epochs) == (20, 30, 30)
    assert (settings.batch_size, settings.learning_rate, settings.link_learning_rate) == (4, 1e-3, 5e-4)
    assert Point2SkeletonSettings(**settings.as_mapping()) == settings


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"points": 1000}, "centroids: .*at most points"),
        ({"centroids": (512, 768, 512, 512)}, "centroids: .*do not increase"),
        ({"centroids": (512, 512)}, "one entry a level"),
        ({"neighbours": ((16,), (32, 64), (32, 64), (64, 128))}, "level 1: "),
        ({"valid_neighbours": 100}, "valid_neighbours: .*less than skeletal_points"),
        ({"graph_channels": ()}, "graph_channels"),
        ({"head_channels": (8, 0)}, "expected at least 1, got 0"),
        ({"dropout": 1.0}, "dropout"),
        ({"link_epochs": 0}, "link_epochs: expected at least 1"),
        ({"learning_rate": 0.0}, "learning_rate: expected more than 0"),
        ({"radius_weight": -0.4}, "radius_weight: expected at least 0"),
    ],
)
def test_contradictions_are_refused(changes, message):
    with pytest.raises(ConfigError, match=message):
        Point2SkeletonSettings(**changes)
