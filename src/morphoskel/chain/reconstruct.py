"""Stage 1: from the cloud to a triangle mesh."""

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_mesh_ply
from morphoskel.surface.reconstruct import REPAIRED, reconstruct, reconstruct_repaired

HEAVY_IMPORTS = (
    "open3d",
    "morphoskel.chain.compiler",
    "morphoskel.volume.triangle_tree_kernels",
    "morphoskel.volume.distance_kernels",
)


def run(task: Task) -> Details:
    """Read the shape's cloud, rebuild its surface and write it as PLY."""
    cloud = read_cloud(task)
    method, settings = task.settings["surface"], task.settings["reconstruction"]
    details: Details = {"points": len(cloud)}
    if method == REPAIRED:
        repair = reconstruct_repaired(cloud, **settings)
        mesh = repair.mesh
        details |= {name: getattr(repair, name) for name in ("missed", "buried", "removed", "added")}
        details["repaired"] = repair.reason
    else:
        mesh = reconstruct(cloud, method, seed=task.seed, **settings)
    write_mesh_ply(task.write(".ply"), mesh)
    return {**details, "triangles": len(mesh.triangles)}
