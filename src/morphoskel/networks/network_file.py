"""The file of a trained network: its weights, and the plain values from which it is built again."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import torch
from torch import nn

from morphoskel.atomic import atomic_file
from morphoskel.checksums import intact_archive
from morphoskel.errors import InputError, StorageError


def write_network(network: nn.Module, path: Path, **values: Any) -> None:
    """Write the weights and plain `values` to one file, whole or not at all.

    Raises
    ------
    StorageError
        If the disk refuses, which PyTorch calls a RuntimeError.
    """
    with atomic_file(path) as partial:
        try:
            torch.save({**values, "weights": network.state_dict()}, partial)
        except (OSError, RuntimeError) as error:
            raise StorageError(
                f"{path}: cannot be written ({error}); check that the disk is writable and has space left, "
                "then run again"
            ) from error


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
    StorageError
        If the file is damaged; PyTorch itself does not notice turned bits.
    """
    try:
        yield torch.load(_checked(Path(path)), map_location="cpu", weights_only=True)
    except FileNotFoundError as error:
        raise InputError(f"{path}: no trained {what} there; train one first") from error
    except StorageError:
        raise
    except Exception as error:  # whatever PyTorch meets in damaged data, or a network in values of another version
        # PyTorch lists every weight that is missing.
        reason = textwrap.shorten(str(error), 300, placeholder=" ...")
        raise InputError(f"{path}: not a {what} of this version ({reason}); train it again") from error


def _checked(path: Path) -> Path:
    """Return the path of a file that was a network and is whole, or that never was one, which PyTorch tells best."""
    with path.open("rb") as stream:
        was_network = stream.read(2) in (b"PK", b"")  # how an archive begins, and what a lost file is cut to
    return intact_archive(path) if was_network else path
