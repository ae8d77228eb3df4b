"""Layers of the interactive viewer that show skeletons, clouds, meshes and chosen points."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from morphoskel.reporting.scene import Layer, Scalar
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud, Skeleton

RADIUS_LABEL = "ball radius, in the shape's unit"
RESIDUE_LABEL = "residue, in the shape's unit"
FEATURE_SIZE_LABEL = "local feature size, in the shape's unit"

FEATURE_SIZE_QUANTILE = 0.95
"""A few sizes far above the others, where the skeleton has a gap, would leave one colour to the rest."""

MOST_POINTS = 200_000
"""Points of a cloud that a page holds; of larger clouds it shows every second, third, and so on."""

MOST_TRIANGLES = 100_000
"""Triangles of a mesh that a page holds; larger ones are simplified."""


def skeleton_layers(skeleton: Skeleton, name: str = "skeleton", *, visible: bool = True) -> list[Layer]:
    """Return the balls, coloured by radius or by residue where there are any, and the sheets and curves between them.

    Parameters
    ----------
    skeleton
        At least one ball. If all radii are 0 its centres are shown as points.
    name
        Begins the names of the layers.
    visible
        Whether they are shown at first.
    """
    scalars = [Scalar(RADIUS_LABEL, skeleton.radii)]
    if skeleton.residues is not None:
        scalars.append(Scalar(RESIDUE_LABEL, skeleton.residues))
    if skeleton.radii.any():
        layers = [
            Layer(name, "balls", skeleton.points, radii=skeleton.radii, scalars=scalars, visible=visible,
                  detail=f"{len(skeleton):,} balls")
        ]  # fmt: skip
    else:
        layers = [
            Layer(name, "points", skeleton.points, scalars=scalars[1:], tone="strong", size=2.0, visible=visible,
                  detail=f"{len(skeleton):,} centres")
        ]  # fmt: skip
    # Where there are balls, what lies between their centres is inside them; it waits to be switched on.
    between = visible and not skeleton.radii.any()
    if len(skeleton.triangles):
        layers.append(
            Layer(f"{name}, sheets", "mesh", skeleton.points, elements=skeleton.triangles, scalars=scalars,
                  opacity=1.0, visible=between, detail=f"{len(skeleton.triangles):,} triangles")
        )  # fmt: skip
    if len(skeleton.edges):
        layers.append(
            Layer(f"{name}, curves", "segments", skeleton.points, elements=skeleton.edges, tone="strong",
                  visible=between, detail=f"{len(skeleton.edges):,} edges")
        )  # fmt: skip
    return layers


def cloud_layer(cloud: PointCloud, name: str = "cloud", *, sizes: FloatArray | None = None, **options: Any) -> Layer:
    """Return the points of a cloud; if it is large every second, third, and so on, as the detail then says.

    Parameters
    ----------
    cloud
        The points.
    name
        Of the layer.
    sizes
        ``(N,)`` float64, the local feature size of each point, to colour it by.
    options
        Of :class:`~morphoskel.reporting.scene.Layer`.
    """
    step = -(-len(cloud) // MOST_POINTS)
    points = cloud.points[::step]
    shown = f"{len(points):,} of {len(cloud):,} points" if step > 1 else f"{len(cloud):,} points"
    scalars = () if sizes is None else (feature_size_scalar(sizes, sizes[::step]),)
    return Layer(name, "points", points, scalars=scalars, detail=shown, **options)


def feature_size_scalar(all_sizes: FloatArray, shown: FloatArray) -> Scalar:
    """Return the local feature sizes `shown`, on a scale that suits all sizes of the shape."""
    return Scalar(FEATURE_SIZE_LABEL, shown, (0.0, float(np.quantile(all_sizes, FEATURE_SIZE_QUANTILE))))


def mesh_layer(
    mesh: Mesh, name: str = "surface", *, triangles: int = MOST_TRIANGLES, tone: Literal["muted", "strong"] = "muted",
    opacity: float = 0.2,
) -> Layer:  # fmt: skip
    """Return a surface, simplified if it has more than `triangles` triangles, as the detail then says.

    Vertices that lie in the same place become one, so that the surface is shaded without seams.

    Parameters
    ----------
    mesh
        The surface.
    name
        Of the layer.
    triangles
        The most that are shown.
    tone, opacity
        Of the layer.

    Notes
    -----
    Simplified by quadric error metrics: M. Garland and P. Heckbert, "Surface Simplification Using Quadric Error
    Metrics", SIGGRAPH 1997, in Open3D's implementation.
    """
    vertices, faces = _welded(mesh)
    shown = f"{len(mesh.triangles):,} triangles"
    if len(faces) > triangles:
        import open3d

        simpler = open3d.geometry.TriangleMesh(
            open3d.utility.Vector3dVector(vertices), open3d.utility.Vector3iVector(faces)
        ).simplify_quadric_decimation(triangles)
        vertices, faces = np.asarray(simpler.vertices), np.asarray(simpler.triangles)
        shown = f"simplified from {len(mesh.triangles):,} to {len(faces):,} triangles"
    vertices, faces = _in_order_of_use(vertices, faces)
    return Layer(name, "mesh", vertices, elements=faces, tone=tone, opacity=opacity, detail=shown)


def _welded(mesh: Mesh) -> tuple[FloatArray, IntArray]:
    """Return vertices and triangles with one vertex in each place, without triangles that this makes a line."""
    vertices, place = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = place.reshape(-1)[mesh.triangles]
    flat = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    return vertices, faces if flat.all() else faces[~flat]


def _in_order_of_use(vertices: FloatArray, faces: IntArray) -> tuple[FloatArray, IntArray]:
    """Return the vertices that are used, numbered as the triangles come to them: neighbours compress well."""
    used, first, place = np.unique(faces, return_index=True, return_inverse=True)
    order = np.argsort(first)
    number = np.empty(len(used), dtype=np.int64)
    number[order] = np.arange(len(used))
    return vertices[used[order]], number[place.reshape(-1)].reshape(-1, 3)
