"""Stage 2: close the surface."""

from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_mesh_ply
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.surface import watertight

HEAVY_IMPORTS = ("point_cloud_utils",)


def run(task: Task) -> Details:
    """Read the rebuilt surface, close it and write it as PLY."""
    mesh = watertight(read_mesh(task.read("reconstruct", ".ply")), seed=task.seed, **task.settings["watertight"])
    write_mesh_ply(task.write(".ply"), mesh)
    return {"triangles": len(mesh.triangles)}
