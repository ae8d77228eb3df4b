"""Stage 6: keep the centres of maximal balls."""

import numpy as np

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.skeleton.selection import skeleton_of

HEAVY_IMPORTS = (
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
)


def run(task: Task) -> Details:
    """Select the inner points of smallest residue and write them as a skeleton."""
    udf = np.load(task.read("udf", ".npy"), allow_pickle=False)
    dilated = np.load(task.read("dilation", ".npy"), allow_pickle=False)
    skeleton = skeleton_of(read_inner_points(task), udf, dilated, task.settings["points"])
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton), "wanted": int(task.settings["points"])}
