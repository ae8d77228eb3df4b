import dataclasses
import inspect

import pytest
import yaml
from conftest import REPOSITORY
from pydantic import ValidationError

from morphoskel.config.sections import Section, parameter_descriptions, section_of
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.skeleton.dpc.settings import DeepPointsSettings
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings
from morphoskel.surface.ponq.settings import PonqSettings

SETTINGS = [L1MedialSettings, DeepPointsSettings, Point2SkeletonSettings, PonqSettings]


@dataclasses.dataclass(frozen=True)
class Knobs:
    """Knobs of a machine: all of them.

    Lengths are in metres.

    Parameters
    ----------
    width, height
        Of the machine,
        measured outside.
    rounds
        How often it turns: 3 is usual.

        More does no harm.

    Raises
    ------
    ValueError
        If it is upside down.
    """

    width: float = 2.0
    height: float | None = None
    rounds: int = 3

    def __post_init__(self):
        if self.height is not None and self.height < self.width:
            raise ValueError("height: expected at least the width")


def test_descriptions_are_those_of_the_docstring():
    assert parameter_descriptions(Knobs) == {
        "width": "Of the machine, measured outside.",
        "height": "Of the machine, measured outside.",
        "rounds": "How often it turns: 3 is usual. More does no harm.",
    }


@pytest.mark.parametrize("settings", SETTINGS)
def test_every_parameter_of_the_library_is_described(settings):
    described = parameter_descriptions(settings)
    assert list(described) == [field.name for field in dataclasses.fields(settings)]
    assert all(described.values())
    assert not any("----" in text or "Raises" in text for text in described.values())


def test_a_section_has_the_fields_of_its_settings():
    section = section_of(Knobs)
    assert issubclass(section, Section)
    assert (section.__name__, section.__doc__) == ("Knobs", inspect.getdoc(Knobs))
    assert {name: field.annotation for name, field in section.model_fields.items()} == {
        "width": float,
        "height": float | None,
        "rounds": int,
    }
    assert section.model_fields["rounds"].description == "How often it turns: 3 is usual. More does no harm."


def test_a_section_gives_its_settings_back():
    values = {"width": 1.0, "height": 4.0, "rounds": 2}
    assert Knobs(**section_of(Knobs).model_validate(values).model_dump()) == Knobs(1.0, 4.0, 2)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"height": 1.0}, "height: expected at least the width"),
        ({"rounds": "many"}, "rounds"),
        ({"depth": 1.0}, "depth"),
    ],
)
def test_a_section_refuses_what_its_settings_refuse(changes, message):
    with pytest.raises(ValidationError, match=message):
        section_of(Knobs).model_validate({"width": 2.0, "height": None, "rounds": 3, **changes})


@pytest.mark.parametrize("missing", ["width", "height", "rounds"])
def test_no_value_is_filled_in_silently(missing):
    values = {"width": 2.0, "height": 3.0, "rounds": 3}
    del values[missing]
    with pytest.raises(ValidationError, match=missing):
        section_of(Knobs).model_validate(values)


def test_a_section_is_frozen():
    section = section_of(Knobs).model_validate({"width": 2.0, "height": None, "rounds": 3})
    with pytest.raises(ValidationError, match="frozen"):
        section.rounds = 4


@pytest.mark.parametrize(("member", "settings"), [("l1_medial", L1MedialSettings), ("dpc", DeepPointsSettings)])
def test_the_configured_defaults_are_the_librarys(member, settings):
    """Both state the defaults of the released programs; neither may drift from the other."""
    configured = yaml.safe_load((REPOSITORY / "config" / "skeleton" / f"{member}.yaml").read_text())
    assert configured == dataclasses.asdict(settings())


def test_the_published_sizes_of_the_network_are_configured():
    """The paper's experiment undoes what the default makes smaller."""
    from morphoskel.config import compose

    configured = compose(["experiment=paper"]).methods.point2skeleton.network
    assert Point2SkeletonSettings(**configured.model_dump()) == Point2SkeletonSettings()
