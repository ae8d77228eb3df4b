"""Read point clouds and meshes of the usual formats; write clouds, meshes and skeletons."""

from morphoskel.formats.read import SUPPORTED_SUFFIXES, read_cloud, read_point_cloud, read_shape
from morphoskel.formats.write import (
    read_skeleton_ply,
    write_cloud_ply,
    write_mesh_ply,
    write_skeleton_npz,
    write_skeleton_ply,
)

__all__ = [
    "SUPPORTED_SUFFIXES",
    "read_cloud",
    "read_point_cloud",
    "read_shape",
    "read_skeleton_ply",
    "write_cloud_ply",
    "write_mesh_ply",
    "write_skeleton_npz",
    "write_skeleton_ply",
]
