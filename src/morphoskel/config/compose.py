"""Compose the Hydra tree and validate the result; the only module that imports Hydra."""

from __future__ import annotations

from collections.abc import Collection, MutableMapping, Sequence
from pathlib import Path
from typing import Any

from morphoskel.config.explain import check_overrides, explain_validation
from morphoskel.config.quoted_paths import quote_paths
from morphoskel.config.schema import Config
from morphoskel.errors import ConfigError

MEMBERS_OF = {"surface": "surface", "skeleton": "methods", "sampler": "samplers", "task": "tasks"}
"""Groups of which several members are chosen, and the sections that hold one entry for each."""


def config_folder() -> Path:
    """Return the folder of the Hydra tree: the repository's ``config/``, or the copy inside an installed wheel."""
    package = Path(__file__).resolve().parent
    repository = package.parents[2] / "config"
    return repository if (repository / "config.yaml").is_file() else package / "tree"


def compose(overrides: Sequence[str] = (), folder: Path | None = None) -> Config:
    """Compose and validate the configuration of an experiment.

    Parameters
    ----------
    overrides
        Hydra overrides such as ``experiment=paper`` or ``skeleton.k=30``; paths need no quotes of Hydra's.
    folder
        The Hydra tree; by default :func:`config_folder`.

    Returns
    -------
    Config
        Validated and frozen.

    Raises
    ------
    ConfigError
        Naming the key, the legal values and the nearest match.
    """
    from hydra import compose as hydra_compose
    from hydra import initialize_config_dir
    from hydra.core.global_hydra import GlobalHydra
    from hydra.errors import HydraException
    from hydra.types import RunMode
    from omegaconf import OmegaConf
    from omegaconf.errors import OmegaConfBaseException

    folder = (folder or config_folder()).resolve()
    if isinstance(overrides, str):
        raise ConfigError(f"overrides: expected a list such as ['experiment=demo'], got the text {overrides!r}")
    overrides = quote_paths(overrides)
    check_overrides(overrides, folder)
    try:
        with initialize_config_dir(config_dir=str(folder), version_base="1.3"):
            tree = hydra_compose("config", overrides=list(overrides))
            loader = GlobalHydra.instance().config_loader()
            members = loader.compute_defaults_list("config", list(overrides), RunMode.RUN).defaults
        OmegaConf.set_struct(tree, False)
        _drop_unchosen(tree, {str(member.config_path) for member in members})
        values: Any = OmegaConf.to_container(tree, resolve=True, throw_on_missing=True)
    except (HydraException, OmegaConfBaseException) as error:
        raise ConfigError(_explain_composition(error)) from error
    return validate(values)


def validate(values: Any) -> Config:
    """Make a configuration of plain values.

    Raises
    ------
    ConfigError
        Naming every key that is wrong, the legal values and the nearest match.
    """
    from pydantic import ValidationError

    try:
        return Config.model_validate(values)
    except ValidationError as error:
        raise ConfigError(explain_validation(error, values)) from error


def _drop_unchosen(tree: Any, chosen: Collection[str]) -> None:
    """Drop what an experiment says of members of a group that are not chosen, so that they do not run."""
    for group, section in MEMBERS_OF.items():
        members = tree.get(section)
        if not isinstance(members, MutableMapping):
            continue  # an override put a plain value in its place, which the schema refuses by name
        for name in list(members):
            if f"{group}/{name}" not in chosen:
                del members[name]


def _explain_composition(error: Exception) -> str:
    """Shorten Hydra's message; for a missing value, name the override that sets it."""
    from omegaconf.errors import MissingMandatoryValue

    if isinstance(error, MissingMandatoryValue):
        key = getattr(error, "full_key", None) or "a mandatory key"
        return f"{key}: has no default; set it, for example {key}=..."
    first_line = str(error).splitlines()[0]
    return f"the configuration cannot be composed: {first_line} Is the key one of the chosen group member's?"
