"""Coverage Axis++ on the inner points of the closed surface."""

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.skeleton.coverage_axis import coverage_axis

HEAVY_IMPORTS = (
    "scipy.spatial",
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
    "morphoskel.skeleton.coverage_axis_kernels",
)


def run(task: Task) -> Details:
    """Choose balls greedily and write them as a skeleton."""
    skeleton = coverage_axis(
        read_cloud(task).points, read_inner_points(task).astype("float64"), **task.settings["coverage_axis"]
    )
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton)}
