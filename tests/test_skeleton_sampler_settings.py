from dataclasses import replace

import pytest
from tiny_skeleton_aware import TINY_SAMPLER

from morphoskel.config.sections import section_of
from morphoskel.errors import ConfigError
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings, TemperatureSettings


def test_settings_survive_as_a_mapping_and_make_a_configuration_section():
    assert SkeletonSamplerSettings(**TINY_SAMPLER.as_mapping()) == TINY_SAMPLER
    section = section_of(SkeletonSamplerSettings)
    assert SkeletonSamplerSettings(**section(**TINY_SAMPLER.as_mapping()).model_dump()) == TINY_SAMPLER
    assert all(field.description for field in section.model_fields.values())


def test_the_temperature_is_put_together_from_its_fields():
    assert TINY_SAMPLER.temperature == TemperatureSettings(start=1.0, end=0.5, annealed_share=0.8, every=2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"k": 0}, "k: expected at least 1, got 0"),
        ({"batch_size": 0}, "batch_size: expected at least 1"),
        ({"channels": ()}, "channels: expected at least one layer"),
        ({"head": (8, 0)}, "head: expected at least one layer"),
        ({"dropout": 1.0}, "dropout: expected at least 0 and less than 1"),
        ({"learning_rate": 0.0}, "learning_rate: expected more than 0"),
        ({"task_penalty": -1.0}, "task_penalty: expected at least 0"),
        ({"temperature_end": 2.0}, "expected start >= end > 0, got start 1.0 and end 2.0"),
        ({"temperature_end": 0.0}, "expected start >= end > 0"),
        ({"temperature_annealed_share": 0.0}, "annealed_share: expected more than 0"),
        ({"temperature_every": 0}, "every: expected at least 1"),
    ],
)
def test_values_out_of_range_are_refused(change, message):
    with pytest.raises(ConfigError, match=message):
        replace(TINY_SAMPLER, **change)
