"""Stage 3: which candidates lie inside."""

from morphoskel.chain.inner import write_occupancy
from morphoskel.chain.task import Details, Task
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.volume import Candidates, occupancy

HEAVY_IMPORTS = (
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
    "morphoskel.volume.occupancy_kernels",
)


def run(task: Task) -> Details:
    """Test all candidates; write the state of each tile, a bit mask, and what is needed to make the same candidates."""
    mesh = read_mesh(task.read("watertight", ".ply"))
    candidates = Candidates(*mesh.bounds, **task.settings["candidates"], seed=task.seed)
    result = occupancy(mesh, candidates, threads=task.threads)
    write_occupancy(task.write(".npz"), result)
    return {"candidates": len(candidates), "inside": len(result)}
