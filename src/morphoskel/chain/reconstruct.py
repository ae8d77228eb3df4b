"""Stage 1: from the cloud to a triangle mesh."""

from morphoskel.chain.task import Details, Task
from morphoskel.datasets.configured import open_configured
from morphoskel.formats import write_mesh_ply
from morphoskel.surface import reconstruct

HEAVY_IMPORTS = ("open3d",)


def run(task: Task) -> Details:
    """Read the shape's cloud, rebuild its surface and write it as PLY."""
    cloud = open_configured(task.settings["dataset"], seed=task.settings["dataset_seed"]).load(task.record.path)
    mesh = reconstruct(cloud, task.settings["surface"], **task.settings["reconstruction"])
    write_mesh_ply(task.write(".ply"), mesh)
    return {"points": len(cloud), "triangles": len(mesh.triangles)}
