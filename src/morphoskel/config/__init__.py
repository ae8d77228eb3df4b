"""The configuration of an experiment: composed by Hydra, validated by pydantic."""

from morphoskel.config.compose import compose, config_folder
from morphoskel.config.schema import Config

__all__ = ["Config", "compose", "config_folder"]
