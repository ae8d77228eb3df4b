"""Stage 3: which candidates lie inside."""

import numpy as np

from morphoskel.chain.task import Details, Task
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.volume import Candidates, SurfaceQuery, occupancy

HEAVY_IMPORTS = ("open3d",)


def run(task: Task) -> Details:
    """Test all candidates and write a bit mask and what is needed to draw the same candidates again."""
    mesh = read_mesh(task.read("watertight", ".ply"))
    candidates = Candidates(*mesh.bounds, **task.settings["candidates"], seed=task.seed)
    mask = occupancy(SurfaceQuery(mesh), candidates)
    np.savez(
        task.write(".npz"),
        mask=np.packbits(mask),
        lower=candidates.lower,
        upper=candidates.upper,
        seed=np.uint64(candidates.seed),
    )
    return {"candidates": len(candidates), "inside": int(mask.sum())}
