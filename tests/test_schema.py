import re
import typing

from pydantic import BaseModel

from morphoskel.config.explain import _all_keys, _sections
from morphoskel.config.schema import Config

DECLARES_KEYS = re.compile(r"schema\.py|(.*_)?(sections|settings)\.py")


def test_every_value_has_a_description():
    def check(model: type[BaseModel]):
        for name, field in model.model_fields.items():
            inner = _sections(field.annotation)
            if not inner and typing.get_origin(field.annotation) is not typing.Literal:
                assert field.description, f"{model.__name__}.{name}"
            for section in inner:
                check(section)

    check(Config)


def test_every_value_is_used():
    """A key that nothing reads is a knob that does nothing. Files that only declare keys do not count."""
    from conftest import REPOSITORY

    code = "\n".join(
        path.read_text()
        for folder in ("src/morphoskel", "workflow")
        for path in (REPOSITORY / folder).rglob("*")
        if path.suffix in (".py", ".smk") and not DECLARES_KEYS.fullmatch(path.name)
    )
    unused = [key for key in _all_keys(Config) if key.split(".")[-1] not in code]
    gathered = "sampling.network.temperature_"  # by a property of the settings
    assert [key for key in unused if not key.startswith(gathered)] == []


def test_unknown_keys_are_refused_everywhere():
    def check(model: type[BaseModel]):
        assert model.model_config["extra"] == "forbid"
        for field in model.model_fields.values():
            for section in _sections(field.annotation):
                check(section)

    check(Config)
