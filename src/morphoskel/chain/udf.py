"""Stage 4: distance from the inner points to the surface."""

import numpy as np

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.task import Details, Task
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.volume import SurfaceQuery

HEAVY_IMPORTS = ("open3d",)


def run(task: Task) -> Details:
    """Measure the UDF of the inner points and write it as float32."""
    mesh = read_mesh(task.read("watertight", ".ply"))
    udf = SurfaceQuery(mesh).udf(read_inner_points(task))
    np.save(task.write(".npy"), udf)
    return {"largest_udf": round(float(udf.max()), 6)}
