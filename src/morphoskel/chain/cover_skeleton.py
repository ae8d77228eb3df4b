"""Stage 6, our own: keep the maximal balls that together explain the cloud."""

import numpy as np

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.inner import read_candidates, read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.morphology.residue import residue
from morphoskel.skeleton.coverage import coverage_skeleton, typical_radius

HEAVY_IMPORTS = (
    "scipy.spatial",
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
    "morphoskel.skeleton.coverage_kernels",
)


def run(task: Task) -> Details:
    """Choose balls for the points of the cloud and write them as a skeleton."""
    udf = np.load(task.read("udf", ".npy"), allow_pickle=False)
    residues = residue(udf, np.load(task.read("dilation", ".npy"), allow_pickle=False))
    skeleton = coverage_skeleton(
        read_inner_points(task),
        udf,
        residues,
        read_cloud(task).points,
        points=task.settings["points"],
        element_radius=typical_radius(read_candidates(task), task.settings["k"]),
        threads=task.threads,
        **task.settings["coverage"],
    )
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton), "wanted": int(task.settings["points"])}
