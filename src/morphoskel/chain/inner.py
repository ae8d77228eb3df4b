"""Draw again the candidates that a shape's bit mask marks as inside."""

import numpy as np
import numpy.typing as npt

from morphoskel.chain.task import Task
from morphoskel.volume import Candidates, inner_points


def read_inner_points(task: Task) -> npt.NDArray[np.float32]:
    """Return the shape's inner points, ``(M, 3)`` float32 in spatial order."""
    with np.load(task.read("occupancy", ".npz")) as stored:
        candidates = Candidates(
            stored["lower"], stored["upper"], **task.settings["candidates"], seed=int(stored["seed"])
        )
        mask = np.unpackbits(stored["mask"], count=len(candidates)).astype(bool)
    return inner_points(candidates, mask)
