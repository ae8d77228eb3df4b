from dataclasses import replace

import pytest
from tiny_skeleton_aware import TINY_SKELETON

from morphoskel.config.sections import section_of
from morphoskel.errors import ConfigError
from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings


def test_settings_survive_as_a_mapping_and_make_a_configuration_section():
    assert SkeletonAwareSettings(**TINY_SKELETON.as_mapping()) == TINY_SKELETON
    section = section_of(SkeletonAwareSettings)
    assert SkeletonAwareSettings(**section(**TINY_SKELETON.as_mapping()).model_dump()) == TINY_SKELETON
    assert all(field.description for field in section.model_fields.values())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"neighbourhood": "voronoi"}, "neighbourhood: expected delaunay or nearest, got 'voronoi'"),
        ({"skeletal_points": 0}, "skeletal_points: expected at least 1, got 0"),
        ({"neighbours": 0}, "neighbours: expected at least 1"),
        ({"hops": 0}, "hops: expected at least 1"),
        ({"weight_channels": ()}, "weight_channels: expected at least one layer"),
        ({"channels": (0,)}, "channels: expected at least one layer"),
        ({"initial_scale": 0.0}, "initial_scale: expected more than 0"),
        ({"pretrain_weight": -1.0}, "pretrain_weight: expected more than 0"),
        ({"radius_weight": -0.1}, "radius_weight: expected at least 0"),
    ],
)
def test_values_out_of_range_are_refused(change, message):
    with pytest.raises(ConfigError, match=message):
        replace(TINY_SKELETON, **change)
