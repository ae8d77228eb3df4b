"""The file of a trained network: its weights, and the plain values from which it is built again."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import torch
from torch import nn

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError


def write_network(network: nn.Module, path: Path, **values: Any) -> None:
    """Write the weights and plain `values` to one file, whole or not at all."""
    with atomic_file(path) as partial:
        torch.save({**values, "weights": network.state_dict()}, partial)


@contextmanager
def read_network(path: Path | str, what: str) -> Iterator[dict[str, Any]]:
    """Hand out the content of a file of :func:`write_network` to code that builds the network from it.

    Parameters
    ----------
    path
        The file. Weights and plain values are read, nothing in it is run.
    what
        Names the kind of network in errors.

    Raises
    ------
    InputError
        If the file is missing, or no such network can be built from it.
    """
    try:
        yield torch.load(path, map_location="cpu", weights_only=True)
    except FileNotFoundError as error:
        raise InputError(f"{path}: no trained {what} there; train one first") from error
    except Exception as error:  # whatever PyTorch meets in damaged data, or a network in values of another version
        raise InputError(f"{path}: not a {what} of this version ({error}); train it again") from error
