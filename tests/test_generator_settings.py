from dataclasses import replace

import pytest
from tiny_generator import TINY

from morphoskel.config.sections import section_of
from morphoskel.errors import ConfigError
from morphoskel.networks.generator_settings import GeneratorSettings


def test_the_settings_survive_being_written_and_make_a_section():
    assert GeneratorSettings(**TINY.as_mapping()) == TINY
    section = section_of(GeneratorSettings)
    assert all(field.is_required() and field.description for field in section.model_fields.values())
    assert GeneratorSettings(**section(**TINY.as_mapping()).model_dump()) == TINY


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"augmentation": "mirror"}, "augmentation: expected none, rotation or dropout, got 'mirror'"),
        ({"point_channels": ()}, "point_channels: expected at least one layer"),
        ({"head_channels": (8, 0)}, "head_channels: expected at least one layer of at least 1 channel"),
        ({"neighbours": -1}, "neighbours: expected at least 0, got -1"),
        ({"batch_size": 1}, "batch_size: expected at least 2"),
        ({"epochs": 0}, "epochs: expected at least 1"),
        ({"decay_share": 0}, "decay_share: expected more than 0"),
        ({"alpha": -1.0}, "alpha: expected at least 0"),
        ({"least_sigma": float("nan")}, "least_sigma: expected at least 0, got nan"),
        ({"decay": 0.0}, "decay: expected more than 0 and at most 1"),
        ({"momentum_decay": 1.1}, "momentum_decay: expected more than 0 and at most 1"),
        ({"learning_rate": 1e-6}, r"least_learning_rate: expected more than 0 and at most learning_rate \(1e-06\)"),
        ({"least_momentum": 0.6}, r"least_momentum: expected more than 0 and at most momentum \(0.5\), got 0.6"),
    ],
)
def test_values_out_of_range_are_refused(changes, message):
    with pytest.raises(ConfigError, match=message):
        replace(TINY, **changes)
