"""A skeleton with all that a skeleton can have, and its surface, to be exported."""

import numpy as np
from solids import ball

from morphoskel.exporting.coloured_parts import coloured_parts
from morphoskel.shapes import Skeleton

SKELETON = Skeleton(
    [[0.0, 0, 0], [0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.5]],
    [0.5, 0.2, 0.1, 0.4],
    np.arange(4.0),
    edges=[[0, 3], [1, 3]],
    triangles=[[0, 1, 2]],
)
SURFACE = ball(subdivisions=2)


def all_parts():
    return coloured_parts(SKELETON, SURFACE, subdivisions=1)
