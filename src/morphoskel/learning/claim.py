"""Keep the checkpoints of different trainings apart."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from torch import Tensor

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError

IDENTITY_FILE = "training.json"
"""Says which training the checkpoints beside it belong to."""


def claim(folder: Path, identity: Mapping[str, Any], tensors: Sequence[Tensor]) -> None:
    """Write down which training a folder belongs to, or refuse to go on with another one's checkpoints.

    Parameters
    ----------
    folder
        Of the training; made if it is not there.
    identity
        What the result depends on beside the tensors, such as settings and seed; JSON must be able to hold it.
    tensors
        The data, known by their digests.

    Raises
    ------
    InputError
        If the folder belongs to another training.
    """
    digests = [hashlib.sha256(tensor.cpu().numpy().tobytes()).hexdigest() for tensor in tensors]
    text = json.dumps({**identity, "sha256_of_clouds": digests}, indent=2)
    path = folder / IDENTITY_FILE
    if not path.exists():
        with atomic_file(path) as partial:
            partial.write_text(text)
    elif path.read_text() != text:
        raise InputError(
            f"{folder}: holds the checkpoints of a training with other settings, clouds or seed, see {path.name}; "
            "choose another folder or delete this one"
        )
