"""Stage 5: dilate the distance function."""

import numpy as np

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.morphology import dilation

HEAVY_IMPORTS = (
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
    "morphoskel.morphology.cell_kernels",
    "morphoskel.morphology.neighbour_kernels",
)


def run(task: Task) -> Details:
    """Dilate the UDF over the k-nearest-neighbour structuring element and write it as float32."""
    udf = np.load(task.read("udf", ".npy"), allow_pickle=False)
    dilated = dilation(read_inner_points(task), udf, task.settings["k"], threads=task.threads)
    np.save(task.write(".npy"), dilated)
    return {"local_maxima": int((dilated == udf).sum())}
