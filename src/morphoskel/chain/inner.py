"""Store which candidates lie inside, and make them again from that."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

from morphoskel.chain.task import Task
from morphoskel.volume import Candidates, Occupancy


def write_occupancy(path: Path, occupancy: Occupancy) -> None:
    """Write two bits a tile, a bit a candidate of the tiles that the surface crosses, and box and seed."""
    states = occupancy.states
    np.savez(
        path,
        states=np.packbits(np.stack([states & 1, states >> 1])),
        crossed_mask=np.packbits(occupancy.crossed_mask),
        crossed=len(occupancy.crossed_mask),
        lower=occupancy.candidates.lower,
        upper=occupancy.candidates.upper,
        seed=np.uint64(occupancy.candidates.seed),
    )


def read_inner_points(task: Task) -> npt.NDArray[np.float32]:
    """Return the shape's inner points, ``(M, 3)`` float32 in spatial order."""
    candidates = read_candidates(task)
    tiles = candidates.tiles_per_axis**3
    with np.load(task.read("occupancy", ".npz"), allow_pickle=False) as stored:
        low, high = np.unpackbits(stored["states"], count=2 * tiles).reshape(2, tiles)
        crossed_mask = np.unpackbits(stored["crossed_mask"], count=int(stored["crossed"])).astype(bool)
    states = (low | high << 1).astype(np.uint8)
    return Occupancy(candidates, states, crossed_mask).inner_points(threads=task.threads)


def read_candidates(task: Task) -> Candidates:
    """Return the candidates that were tested."""
    with np.load(task.read("occupancy", ".npz"), allow_pickle=False) as stored:
        return Candidates(stored["lower"], stored["upper"], **task.settings["candidates"], seed=int(stored["seed"]))
