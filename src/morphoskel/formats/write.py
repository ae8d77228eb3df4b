"""Write clouds, meshes and skeletons; binary PLY that MeshLab, Open3D and trimesh open."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.formats.assemble import Polygons, as_whole_numbers, triangulate_fans
from morphoskel.formats.ply import parse_ply_elements, stack_properties
from morphoskel.formats.ply_body import RaggedList
from morphoskel.shapes import FloatArray, IntArray, Mesh, PointCloud, Skeleton

_TYPE_NAMES = {"f4": "float", "f8": "double", "i4": "int"}


def write_cloud_ply(path: Path, cloud: PointCloud) -> None:
    """Write a cloud as binary PLY: ``x y z``, if known ``nx ny nz`` as float32, and ``label`` as int32.

    Raises
    ------
    InputError
        If values do not fit these types, so that the file could not be read back as a cloud.
    """
    columns = {name: _as_float32(cloud.points[:, axis], path) for axis, name in enumerate(("x", "y", "z"))}
    try:
        PointCloud(np.stack(list(columns.values()), axis=1))
    except InputError as error:
        raise InputError(f"{path}: points differ by less than float32 resolves; shift them to the origin") from error
    if cloud.normals is not None:
        columns |= {name: _as_float32(cloud.normals[:, axis], path) for axis, name in enumerate(("nx", "ny", "nz"))}
    table: dict[str, npt.NDArray[Any]] = dict(columns)
    if cloud.labels is not None:
        if np.abs(cloud.labels).max() > np.iinfo(np.int32).max:
            raise InputError(f"{path}: labels must fit into 32 bits; renumber the parts")
        table["label"] = cloud.labels.astype("<i4")
    _write(path, _header(table), _rows(table).tobytes())


def write_mesh_ply(path: Path, mesh: Mesh) -> None:
    """Write a mesh as binary PLY: float32 vertices, triangles as lists of int32.

    Raises
    ------
    InputError
        If a coordinate or an index does not fit these types.
    """
    if len(mesh.vertices) > np.iinfo(np.int32).max:
        raise InputError(f"{path}: {len(mesh.vertices)} vertices are more than 32 bits can number; simplify the mesh")
    table: dict[str, npt.NDArray[Any]] = {
        name: _as_float32(mesh.vertices[:, axis], path) for axis, name in enumerate(("x", "y", "z"))
    }
    faces = _faces(mesh.triangles)
    extra = (f"element face {len(faces)}", "property list uchar int vertex_indices")
    _write(path, _header(table, *extra), _rows(table).tobytes() + faces.tobytes())


def write_skeleton_ply(path: Path, skeleton: Skeleton) -> None:
    """Write a skeleton as binary PLY with the float64 properties ``x y z radius``, so nothing is rounded.

    Where the skeleton has them, ``residue`` is a fifth property, and its edges and triangles are the elements
    ``edge`` (``vertex1 vertex2``) and ``face``.
    """
    columns = dict(zip(("x", "y", "z", "radius"), (*skeleton.points.T, skeleton.radii), strict=True))
    if skeleton.residues is not None:
        columns["residue"] = skeleton.residues
    table = {name: column.astype("<f8") for name, column in columns.items()}
    extra = []
    if len(skeleton.edges):
        extra += [f"element edge {len(skeleton.edges)}", "property int vertex1", "property int vertex2"]
    if len(skeleton.triangles):
        extra += [f"element face {len(skeleton.triangles)}", "property list uchar int vertex_indices"]
    body = _rows(table).tobytes() + skeleton.edges.astype("<i4").tobytes() + _faces(skeleton.triangles).tobytes()
    _write(path, _header(table, *extra), body)


def read_skeleton_ply(path: Path | str) -> Skeleton:
    """Read a skeleton that :func:`write_skeleton_ply` wrote, exactly as it was.

    Raises
    ------
    InputError
        If the file is missing, damaged, or no skeleton.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    try:
        elements = parse_ply_elements(content)
        vertex = elements.get("vertex", {})
        values = stack_properties(vertex, ("x", "y", "z", "radius"))
        residues = stack_properties(vertex, ("residue",))[:, 0] if "residue" in vertex else None
        parts = {}
        if "edge" in elements:
            parts["edges"] = as_whole_numbers(stack_properties(elements["edge"], ("vertex1", "vertex2")), "edges")
        faces = elements.get("face", {}).get("vertex_indices")
        if isinstance(faces, RaggedList):
            parts["triangles"] = triangulate_fans(Polygons(faces.counts, as_whole_numbers(faces.values, "faces")))
        return Skeleton(values[:, :3], values[:, 3], residues, **parts)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def write_skeleton_npz(path: Path, skeleton: Skeleton) -> None:
    """Write a skeleton as NumPy arrays named like its fields; equal skeletons give equal bytes."""
    names = ("points", "radii", "residues", "edges", "triangles")
    arrays = {name: array for name in names if (array := getattr(skeleton, name)) is not None and len(array)}
    with atomic_file(path) as partial, partial.open("wb") as stream:
        np.savez(stream, **arrays)


def _faces(triangles: IntArray) -> npt.NDArray[Any]:
    """Return triangles as the packed rows of a list property."""
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", (3,))])
    faces["count"] = 3
    faces["corners"] = triangles
    return faces


def _as_float32(values: FloatArray, path: Path) -> npt.NDArray[np.float32]:
    """Return `values` as little-endian float32, or say that one is too large."""
    with np.errstate(over="ignore", under="ignore"):
        narrow = values.astype("<f4")
    if not np.isfinite(narrow).all():
        raise InputError(f"{path}: coordinates beyond the range of float32 (3e38) cannot be written; rescale the shape")
    return narrow


def _header(table: dict[str, npt.NDArray[Any]], *extra: str) -> bytes:
    """Return a PLY header for vertices with the columns of `table`."""
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(next(iter(table.values())))}"]
    lines += [f"property {_TYPE_NAMES[column.dtype.str[1:]]} {name}" for name, column in table.items()]
    return "\n".join([*lines, *extra, "end_header", ""]).encode("ascii")


def _rows(table: dict[str, npt.NDArray[Any]]) -> npt.NDArray[Any]:
    """Return the columns as packed rows."""
    rows = np.empty(len(next(iter(table.values()))), dtype=[(name, column.dtype) for name, column in table.items()])
    for name, column in table.items():
        rows[name] = column
    return rows


def _write(path: Path, header: bytes, body: bytes) -> None:
    with atomic_file(Path(path)) as partial:
        partial.write_bytes(header + body)
