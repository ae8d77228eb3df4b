"""Deep points consolidation of the cloud."""

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.skeleton.dpc import DeepPointsSettings, deep_points

HEAVY_IMPORTS = (
    "scipy.spatial",
    "morphoskel.chain.compiler",
    "morphoskel.skeleton.dpc.sinking_kernels",
    "morphoskel.skeleton.dpc.meso_skeleton_kernels",
)


def run(task: Task) -> Details:
    """Sink the points of the cloud to the meso-skeleton and write it."""
    skeleton = deep_points(read_cloud(task), DeepPointsSettings(**task.settings["dpc"]))
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton)}
