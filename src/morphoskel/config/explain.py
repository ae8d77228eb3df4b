"""Say what is wrong with a configuration: the key, the legal values and the nearest match."""

from __future__ import annotations

import difflib
import types
import typing
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from morphoskel.config.schema import Config
from morphoskel.errors import ConfigError

if TYPE_CHECKING:
    from pydantic import ValidationError
    from pydantic.fields import FieldInfo


def check_overrides(overrides: Sequence[str], folder: Path) -> None:
    """Refuse an override whose key or group member does not exist.

    Raises
    ------
    ConfigError
        Naming the key, the legal ones and the nearest match.
    """
    from hydra.core.override_parser.overrides_parser import OverridesParser
    from hydra.errors import HydraException

    groups = {
        group.name: sorted(member.stem for member in group.glob("*.yaml"))
        for group in sorted(folder.iterdir())
        if any(group.glob("*.yaml"))
    }
    for text in overrides:
        try:
            override = OverridesParser.create().parse_override(str(text))
            value = override.value()
        except (HydraException, ValueError, RecursionError) as error:  # ValueError of a number of thousands of digits
            raise ConfigError(f"{text!r} is not an override; expected key=value, for example skeleton.k=30") from error
        key = override.key_or_group
        if key in groups:
            if value is None and not override.is_delete():
                raise ConfigError(f"{key}: null is no choice; to choose none, write ~{key}")
            chosen = value if isinstance(value, list) else [value]
            for member in chosen:
                if member is not None and str(member) not in groups[key]:
                    raise ConfigError(f"{key}: no such choice {member!r}; {_legal(str(member), groups[key])}")
        elif not _exists(key.split("."), Config):
            raise ConfigError(_explain_unknown(key, groups))


def explain_validation(error: ValidationError, values: Mapping[str, Any]) -> str:
    """Turn pydantic's findings into one line a finding, with the key, what was found and what is legal."""
    lines = []
    for finding in error.errors():
        location = [
            str(part)
            for place, part in enumerate(finding["loc"])
            if not (place == 1 and finding["loc"][0] in ("dataset", "parts") and part in _UNION_TAGS)
        ]
        key = ".".join(location)
        if finding["type"] == "extra_forbidden":
            legal = _keys_beside(location)
            lines.append(f"{key}: no such key; {_legal(location[-1], legal)}")
        elif finding["type"] == "missing":
            lines.append(f"{key}: missing{_describe(location)}")
        else:
            message = finding["msg"].removeprefix("Value error, ")
            secret = key.endswith(".url")  # an address may hold a password
            found = "" if secret or isinstance(finding["input"], Mapping) else f", got {finding['input']!r}"
            # A check of the whole configuration has no place and names the keys itself.
            lines.append(f"{key}: {message}{found}{_describe(location)}" if location else message)
    return "\n".join(lines)


def _explain_unknown(key: str, groups: Mapping[str, Iterable[str]]) -> str:
    parents = key.split(".")[:-1]
    sections = _models(parents, Config)
    if sections and not any(model.model_fields for model in sections):
        return f"{key}: no such key; {'.'.join(parents)} has no settings"
    known = [name for model in sections for name in model.model_fields]
    if not known:
        return f"{key}: no such key; {_legal(key, [*_all_keys(Config), *groups])}"
    legal = [".".join([*parents, name]) for name in known]
    if not parents:
        legal += [group for group in groups if group not in legal]
    return f"{key}: no such key; {_legal(key, legal)}"


def _legal(wrong: str, legal: Sequence[str]) -> str:
    """Return "did you mean ..., legal are ..."."""
    names = sorted(set(legal))
    nearest = difflib.get_close_matches(wrong, names, n=1, cutoff=0.5)
    guess = f"did you mean {nearest[0]!r}? " if nearest else ""
    return f"{guess}Legal: {', '.join(names)}"


def _models(parents: Sequence[str], root: type[BaseModel]) -> list[type[BaseModel]]:
    """Return the section models that the dotted path `parents` can lead to (several for a data set's kinds)."""
    models = [root]
    for part in parents:
        models = [
            inner
            for model in models
            if part in model.model_fields
            for inner in _sections(model.model_fields[part].annotation)
        ]
    return models


def fields_at(parts: Sequence[str]) -> list[FieldInfo]:
    """Return the fields of the schema that a dotted key can mean (several for a data set's kinds)."""
    return [model.model_fields[parts[-1]] for model in _models(parts[:-1], Config) if parts[-1] in model.model_fields]


def _sections(annotation: Any) -> list[type[BaseModel]]:
    """Return the section models inside a type such as ``A | B | None``."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    if typing.get_origin(annotation) in (typing.Union, types.UnionType, typing.Annotated):
        return [model for part in typing.get_args(annotation) for model in _sections(part)]
    return []


def _exists(parts: Sequence[str], root: type[BaseModel]) -> bool:
    """Tell whether a dotted key leads to a field, or into a field that is a mapping."""
    for depth in range(len(parts)):
        fields = [
            model.model_fields[parts[depth]]
            for model in _models(parts[:depth], root)
            if parts[depth] in model.model_fields
        ]
        if not fields:
            return False
        if any(typing.get_origin(field.annotation) is dict for field in fields):
            return True
    return True


def _all_keys(root: type[BaseModel], prefix: str = "") -> list[str]:
    keys = []
    for name, field in root.model_fields.items():
        sections = _sections(field.annotation)
        keys += [key for section in sections for key in _all_keys(section, f"{prefix}{name}.")]
        if not sections:
            keys.append(f"{prefix}{name}")
    return sorted(set(keys))


def _keys_beside(location: Sequence[str]) -> list[str]:
    return [name for model in _models(location[:-1], Config) for name in model.model_fields]


def _describe(location: Sequence[str]) -> str:
    """Return the description of a key from the schema, where it has one."""
    for field in fields_at(location):
        if field.description:
            return f" ({field.description})"
    return ""


_UNION_TAGS = frozenset(
    literal
    for model in _sections(Config.model_fields["dataset"].annotation)
    for literal in typing.get_args(model.model_fields["kind"].annotation)
)
"""pydantic puts the chosen kind of data set into an error's location, where the user wrote no such key."""
