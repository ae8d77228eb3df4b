from dataclasses import fields, replace

import pytest
from tiny_classifier import TINY

from morphoskel.config.sections import parameter_descriptions
from morphoskel.errors import ConfigError
from morphoskel.networks.classifier_settings import ClassifierSettings


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("dropped_points", 1.0),
        ("dropped_points", -0.1),
        ("drop_style", "mask"),
        ("lowest_scale", 0.0),
        ("lowest_scale", 2.0),
        ("shift", -0.1),
        ("feature_dropout", 1.0),
        ("penalty", float("nan")),
        ("batch_size", 1),
        ("epochs", 0),
        ("learning_rate", 0.0),
        ("weight_decay", -1e-4),
        ("decay", 0.0),
        ("decay", 1.1),
        ("decay_epochs", 0),
    ],
)
def test_bad_values_are_refused_by_name(name, value):
    with pytest.raises(ConfigError, match=name):
        replace(TINY, **{name: value})


def test_the_edges_are_allowed_and_every_field_is_described():
    replace(TINY, dropped_points=0.0, shift=0.0, penalty=0.0, decay=1.0, lowest_scale=1.25)
    assert ClassifierSettings(**TINY.as_mapping()) == TINY
    assert set(parameter_descriptions(ClassifierSettings)) == {field.name for field in fields(ClassifierSettings)}
