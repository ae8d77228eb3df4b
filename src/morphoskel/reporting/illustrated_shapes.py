"""Shapes on which figures show the method: known by name, or a file of the user's."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from morphoskel.errors import InputError
from morphoskel.shapes import Mesh, PointCloud

EXACT_SOLIDS = ("torus", "box")
"""Their surfaces are closed, and known; the watertight conversion would only round them."""

NAMED_SHAPES = ("dragon", *EXACT_SOLIDS)

RING, TUBE = 0.7, 0.3
"""Radii of the torus: of the circle in the middle of the tube, and of the tube."""

BOX = (1.7, 0.9, 0.55)
"""Edge lengths of the box; no two are alike, so that its skeleton has all kinds of sheets."""

SOLID_CANDIDATES = 63**3
"""Of a grid in these solids. As the number of nodes an axis is odd, one layer of them lies in the box's middle sheet.
It has 1,025 nodes of equal residue: 1,024 points show it whole, but only a part of the sheet of a finer grid."""


def named_shape(name: str) -> Mesh:
    """Return a closed surface that lies within the unit ball.

    Parameters
    ----------
    name
        ``dragon``, made by us in place of the Stanford dragon of the paper, see
        :mod:`morphoskel.datasets.synthetic.dragon`; ``torus``, standing upright with its axis along z; ``box``.

    Raises
    ------
    InputError
        If there is no such shape.
    """
    import trimesh

    if name == "dragon":
        from morphoskel.datasets.synthetic.dragon import dragon

        return dragon()
    if name == "torus":
        solid = trimesh.creation.torus(RING, TUBE, major_sections=256, minor_sections=128)
    elif name == "box":
        solid = trimesh.creation.box(np.array(BOX) / np.linalg.norm(BOX) * 2)
    else:
        raise InputError(f"no shape is called {name!r}; expected {', '.join(NAMED_SHAPES)}, or the path of a file")
    return Mesh(solid.vertices, solid.faces)


def shape_from(source: str | Path, *, samples: int | None = None, generator: np.random.Generator) -> Mesh | PointCloud:
    """Return a named shape, or the shape in a file.

    Parameters
    ----------
    source
        One of :data:`NAMED_SHAPES`, or a file of any supported format.
    samples
        Draw as many points on a mesh, uniformly by area, and return this cloud; ``None`` returns the mesh.
    generator
        Source of randomness of these points.

    Raises
    ------
    InputError
        If there is no such shape and no such file, or the file cannot be read.
    """
    from morphoskel.formats import read_shape
    from morphoskel.formats.sample import sample_surface

    is_file = isinstance(source, Path) or source not in NAMED_SHAPES
    if is_file and not Path(source).is_file():
        raise InputError(f"{source}: neither a file nor one of {', '.join(NAMED_SHAPES)}")
    shape = read_shape(source) if is_file else named_shape(str(source))
    if samples is None or isinstance(shape, PointCloud):
        return shape
    return sample_surface(shape, samples, generator)
