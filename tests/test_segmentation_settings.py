from dataclasses import replace

import pytest
from tiny_parts import TINY

from morphoskel.config.sections import section_of
from morphoskel.errors import ConfigError
from morphoskel.learning.plain_values import as_tuples
from morphoskel.networks.segmentation_settings import SegmentationSettings


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("before", ()),
        ("after", (8, 0)),
        ("point_transform_channels", ()),
        ("feature_transform_head", (0,)),
        ("head", ()),
        ("cloud_features", 0),
        ("dropout", 1.0),
        ("dropout", -0.1),
        ("penalty", float("nan")),
        ("batch_size", 1),
        ("epochs", 0),
        ("learning_rate", 0.0),
        ("decay", 0.0),
        ("decay", 1.1),
        ("decay_epochs", 0),
        ("lowest_learning_rate", -1e-5),
        ("lowest_learning_rate", 0.1),
        ("training_input", "some"),
        ("training_points", 0),
    ],
)
def test_bad_values_are_refused_by_name(name, value):
    with pytest.raises(ConfigError, match=f"^{name}: expected"):
        replace(TINY, **{name: value})


def test_settings_survive_as_a_mapping_and_make_a_configuration_section():
    replace(TINY, dropout=0.0, penalty=0.0, decay=1.0, lowest_learning_rate=TINY.learning_rate)
    assert SegmentationSettings(**TINY.as_mapping()) == TINY
    section = section_of(SegmentationSettings)
    configured = section(**TINY.as_mapping()).model_dump(mode="json")  # with lists, as a file has them
    assert SegmentationSettings(**{name: as_tuples(value) for name, value in configured.items()}) == TINY
    assert all(field.description for field in section.model_fields.values())


def test_settings_are_changed_where_a_value_is_given():
    changed = TINY.changed({"epochs": TINY.epochs + 1, "decay_epochs": None})
    assert changed == replace(TINY, epochs=TINY.epochs + 1)
    with pytest.raises(ConfigError, match=r"^epochs: expected"):
        TINY.changed({"epochs": 0})
