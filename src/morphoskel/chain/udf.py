"""Stage 4: distance from the inner points to the surface."""

import numpy as np

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.volume import SurfaceDistance

HEAVY_IMPORTS = (
    "morphoskel.chain.compiler",
    "morphoskel.volume.candidate_kernels",
    "morphoskel.volume.triangle_tree_kernels",
    "morphoskel.volume.distance_kernels",
)


def run(task: Task) -> Details:
    """Measure the UDF of the inner points and write it as float32."""
    distance = SurfaceDistance(read_mesh(task.read("watertight", ".ply")))
    udf = distance(read_inner_points(task), threads=task.threads)
    np.save(task.write(".npy"), udf)
    return {"largest_udf": round(float(udf.max()), 6)}
