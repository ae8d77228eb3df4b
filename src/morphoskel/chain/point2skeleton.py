"""Point2Skeleton's prediction for the cloud."""

from pathlib import Path

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.skeleton.point2skeleton import point2skeleton

HEAVY_IMPORTS = ("scipy.spatial", "torch", "morphoskel.networks.point2skeleton_network")


def run(task: Task) -> Details:
    """Predict balls and the mesh between them, and write them as a skeleton."""
    import torch

    from morphoskel.networks.point2skeleton_network import load_point2skeleton

    torch.set_num_threads(task.threads)
    network = load_point2skeleton(Path(task.settings["network"]))
    skeleton = point2skeleton(read_cloud(task), network, refine_radii=task.settings["refine_radii"])
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton), "edges": len(skeleton.edges), "triangles": len(skeleton.triangles)}
