"""Configuration sections made from settings that the library describes, so that nothing is told twice."""

from __future__ import annotations

import dataclasses
import inspect
import re
from typing import Any, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator


class Section(BaseModel):
    """Base of all sections."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def section_of(settings: type[Any]) -> type[Section]:
    """Return a section with the fields of a dataclass, all of them required, and its own checks.

    Parameters
    ----------
    settings
        A dataclass whose docstring describes its fields under "Parameters".
    """
    hints = get_type_hints(settings)
    described = parameter_descriptions(settings)
    fields: dict[str, Any] = {
        field.name: (hints[field.name], Field(description=described[field.name]))
        for field in dataclasses.fields(settings)
    }

    def check(section: Section) -> Section:
        settings(**section.model_dump())
        return section

    validators: dict[str, Any] = {"check": model_validator(mode="after")(check)}
    model: type[Section] = create_model(
        settings.__name__, __base__=Section, __doc__=inspect.getdoc(settings), __validators__=validators, **fields
    )
    return model


def parameter_descriptions(documented: type[Any]) -> dict[str, str]:
    """Return what a numpydoc docstring says of each parameter, on one line."""
    text = inspect.getdoc(documented) or ""
    parameters = text.partition("Parameters\n----------\n")[2]
    parameters = re.split(r"\n\n[A-Z][a-z]+\n-+\n", parameters)[0]
    described = {}
    for entry in re.split(r"\n(?=\S)", parameters):
        names, _, body = entry.partition("\n")
        for name in names.split(","):
            described[name.strip()] = " ".join(body.split())
    return described
