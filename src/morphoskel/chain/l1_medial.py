"""The L1-medial skeleton of the cloud."""

import numpy as np

from morphoskel.chain.cloud import read_cloud
from morphoskel.chain.task import Details, Task
from morphoskel.formats import write_skeleton_ply
from morphoskel.skeleton.l1_medial import L1MedialSettings, l1_medial

HEAVY_IMPORTS = ("scipy.spatial", "morphoskel.chain.compiler", "morphoskel.skeleton.l1_medial.contraction_kernels")


def run(task: Task) -> Details:
    """Contract the cloud to curves and write them as a skeleton."""
    settings = L1MedialSettings(**task.settings["l1_medial"])
    skeleton = l1_medial(read_cloud(task), np.random.default_rng(task.seed), settings)
    write_skeleton_ply(task.write(".ply"), skeleton)
    return {"balls": len(skeleton), "edges": len(skeleton.edges)}
