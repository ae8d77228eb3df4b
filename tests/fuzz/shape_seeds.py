"""Whole files of shapes, skeletons and arrays: small, so that each is read thousands of times a second."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from morphoskel.formats import write_cloud_ply, write_mesh_ply, write_skeleton_npz, write_skeleton_ply
from morphoskel.shapes import Mesh, PointCloud, Skeleton

REPOSITORY = Path(__file__).resolve().parents[2]
POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1], [0.25, 0.5, 0.5]], dtype=np.float64)
NORMALS = np.tile([0.0, 0.6, 0.8], (6, 1))
LABELS = np.array([0, 0, 1, 1, 2, 2])
PYRAMID = Mesh(POINTS[:5], np.array([[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]))
CURVE = Skeleton(POINTS, np.linspace(0.1, 0.6, 6), edges=np.array([[0, 1], [1, 2], [4, 5]]))
SHEET = Skeleton(POINTS, np.linspace(0.1, 0.6, 6), np.zeros(6), triangles=np.array([[0, 1, 2], [2, 3, 4]]))


def written(path: Path, *writes: Callable[[Path], Any]) -> list[bytes]:
    """Return what each of `writes` puts into the file at `path`."""
    contents = []
    for write in writes:
        write(path)
        contents.append(path.read_bytes())
    return contents


def arrays(path: Path, *mappings: Mapping[str, Any], compressed: bool = False) -> list[bytes]:
    """Return NPZ files with these arrays."""
    save = np.savez_compressed if compressed else np.savez
    return written(path, *(lambda path, mapping=mapping: save(path, **mapping) for mapping in mappings))


def extracts(pattern: str, most: int = 2) -> Iterator[bytes]:
    """Yield the beginnings of files of the real data sets, where these are at hand."""
    root = Path(os.environ.get("MORPHOSKEL_DATA", REPOSITORY.parent / "shared" / "data"))
    for path in sorted(root.glob(pattern))[:most]:
        yield path.read_bytes()


def first_lines(content: bytes, count: int = 20) -> bytes:
    """Return the first lines."""
    return b"".join(content.splitlines(keepends=True)[:count])


def exported(mesh: Mesh, kind: str) -> bytes:
    """Return what trimesh writes."""
    content = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).export(file_type=kind)
    return content.encode() if isinstance(content, str) else content


def ply_files(folder: Path) -> list[bytes]:
    """Return clouds and meshes of our own and of trimesh, ASCII and binary."""
    path = folder / "seed.ply"
    ours = written(
        path,
        lambda path: write_cloud_ply(path, PointCloud(POINTS)),
        lambda path: write_cloud_ply(path, PointCloud(POINTS, NORMALS, LABELS)),
        lambda path: write_mesh_ply(path, PYRAMID),
    )
    text = (
        "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nelement face 5\nproperty list uchar int vertex_index\nend_header\n"
        + "".join(f"{x:g} {y:g} {z:g} 255\n" for x, y, z in POINTS[:5])
        + "4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
    )
    uneven = (
        b"ply\nformat binary_big_endian 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
        b"property double z\nelement face 2\nproperty list ushort uint vertex_indices\nproperty uchar flag\n"
        b"end_header\n"
        + POINTS[:5].astype(">f8").tobytes()
        + b"\0\4" + np.array([0, 1, 2, 3], ">u4").tobytes() + b"\1"
        + b"\0\3" + np.array([0, 1, 4], ">u4").tobytes() + b"\1"
    )  # fmt: skip
    return [*ours, exported(PYRAMID, "ply"), text.encode(), uneven, *map(_short_ply, extracts("*/pointclouds/*/*.ply"))]


def _short_ply(content: bytes) -> bytes:
    header, mark, body = content.partition(b"end_header\n")
    return re.sub(rb"element vertex \d+", b"element vertex 8", header) + mark + first_lines(body, 8)


def pcd_files(folder: Path) -> list[bytes]:
    """Return what Open3D writes: ASCII, binary and compressed, with and without normals."""
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(POINTS))
    contents = []
    for with_normals in (False, True):
        if with_normals:
            cloud.normals = open3d.utility.Vector3dVector(NORMALS)
        for options in ({"write_ascii": True}, {}, {"compressed": True}):
            path = folder / "seed.pcd"
            open3d.io.write_point_cloud(str(path), cloud, **options)
            contents.append(path.read_bytes())
    return [*contents, *map(_short_pcd, extracts("modelnet10_clouds/*/*/*.pcd"))]


def _short_pcd(content: bytes) -> bytes:
    header, mark, body = content.partition(b"DATA binary\n")
    return re.sub(rb"(WIDTH|POINTS) \d+", rb"\1 8", header) + mark + body[: 8 * 12]


def obj_files(folder: Path) -> list[bytes]:
    """Return meshes and clouds, with and without normals, and a face in every notation."""
    notations = b"v 0 0 0\nv 1 0 0 1.0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1/1 2/2 3/3\nf 1//1 2//1 4//1\nf -1 -2 \\\n-3\n"
    cloud = "".join(f"v {x} {y} {z}\nvn 0 0 1\n" for x, y, z in POINTS)
    return [exported(PYRAMID, "obj"), notations, cloud.encode()]


def off_files(folder: Path) -> list[bytes]:
    """Return what trimesh writes, a file as ModelNet has them, and one with normals."""
    content = exported(PYRAMID, "off")
    normals = "NOFF\n6 0 0\n" + "".join(f"{x} {y} {z} 0 0.6 0.8\n" for x, y, z in POINTS)
    return [content, content.replace(b"OFF\n", b"OFF", 1), normals.encode()]


def stl_files(folder: Path) -> list[bytes]:
    """Return both kinds that trimesh writes."""
    return [exported(PYRAMID, "stl"), exported(PYRAMID, "stl_ascii")]


def text_files(folder: Path) -> list[bytes]:
    """Return columns of every legal number, with either separator, and with the number of points in front."""
    columns = np.column_stack([POINTS, NORMALS, LABELS])
    tables = [columns[:, :3], columns[:, [0, 1, 2, 6]], columns[:, :6], columns]
    ours = ["\n".join(" ".join(f"{value:g}" for value in row) for row in table) for table in tables]
    ours += [ours[2].replace(" ", ","), f"6\n{ours[0]}", f"# x y z\n{ours[0]}\n"]
    real = [*extracts("modelnet40_normal_resampled/airplane/*.txt"), *extracts("shapenetpart_*/*/*.txt"),
            *extracts("shapenetpart_raw/*/points/*.pts")]  # fmt: skip
    return [*(text.encode() for text in ours), *map(first_lines, real)]


def npy_files(folder: Path) -> list[bytes]:
    """Return arrays of several types and orders."""
    tables = (POINTS, np.asfortranarray(POINTS.astype(">f4")), np.column_stack([POINTS, NORMALS]), POINTS.astype("i4"))
    return written(folder / "seed.npy", *(lambda path, table=table: np.save(path, table) for table in tables))


def npz_files(folder: Path) -> list[bytes]:
    """Return a cloud and a mesh, stored and compressed."""
    cloud = {"points": POINTS, "normals": NORMALS, "labels": LABELS}
    mesh = {"vertices": PYRAMID.vertices, "triangles": PYRAMID.triangles}
    path = folder / "seed.npz"
    return [*arrays(path, cloud, mesh), *arrays(path, cloud, compressed=True)]


def skeleton_ply_files(folder: Path) -> list[bytes]:
    """Return curves and sheets, and a medial axis as it comes with the Point2Skeleton shapes."""
    axis = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    axis += b"property float r\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    axis += b"0 0 0 .1\n1 0 0 .2\n0 1 0 .1\n0 0 1 0\n3 0 1 2\n"
    skeletons = (CURVE, SHEET)
    ours = written(
        folder / "seed.ply",
        *(lambda path, skeleton=skeleton: write_skeleton_ply(path, skeleton) for skeleton in skeletons),
    )
    return [*ours, axis]


def skeleton_npz_files(folder: Path) -> list[bytes]:
    """Return curves and sheets."""
    return written(
        folder / "seed.npz",
        *(lambda path, skeleton=skeleton: write_skeleton_npz(path, skeleton) for skeleton in (CURVE, SHEET)),
    )


def medial_axis_files(folder: Path) -> list[bytes]:
    """Return medial axes with and without edges, faces and flags."""
    vertices = "".join(f"v {x} {y} {z} 0.25\n" for x, y, z in POINTS)
    return [
        f"6 2 1\n{vertices}e 0 1\ne 1 2\nf 0 1 2\n".encode(),
        f"# program\n6 0 1\n{vertices}f 3 4 5 1 0\n".encode(),
        f"6 0 0\n{vertices}".encode(),
    ]


def chosen_points_files(folder: Path) -> list[bytes]:
    """Return what `morphoskel sample` writes for a cloud and for a mesh."""
    few = {"indices": np.array([0, 3, 4, 5]), "points": POINTS[[0, 3, 4, 5]]}
    sizes = {"local_feature_size": np.linspace(0.1, 0.6, 6), "skeleton_points": POINTS, "skeleton_radii": CURVE.radii}
    return arrays(folder / "seed.npz", few, {**few, "cloud": POINTS, **sizes})


@cache
def small_cloud_set() -> Any:
    """Return three clouds of six points with parts."""
    from morphoskel.datasets.cloud_set import CloudSet

    return CloudSet(
        ids=np.array(["a", "b", "c"]), labels=np.array([0, 1, 1]), class_names=np.array(["ball", "box"]),
        points=np.stack([POINTS] * 3).astype(np.float32), centres=np.zeros((3, 3)), scales=np.ones(3),
        parts=np.stack([LABELS] * 3), part_classes=np.array([0, 1, 1]),
    )  # fmt: skip


def cloud_set_files(folder: Path) -> list[bytes]:
    """Return clouds with and without parts."""
    from dataclasses import replace

    from morphoskel.datasets.cloud_set import write_cloud_set

    with_parts = small_cloud_set()
    sets = (with_parts, replace(with_parts, parts=None, part_classes=None))
    return written(folder / "seed.npz", *(lambda path, clouds=clouds: write_cloud_set(clouds, path) for clouds in sets))


def prior_set_files(folder: Path) -> list[bytes]:
    """Return local feature sizes, one shape without."""
    from morphoskel.sampling.prior_set import PriorSet, write_prior_set

    distances = np.full((3, 6), 0.5, dtype=np.float32)
    distances[1] = np.nan
    priors = PriorSet(small_cloud_set().ids, distances, np.array(["", "poisson: no surface", ""]))
    return written(folder / "seed.npz", lambda path: write_prior_set(priors, path))


def choice_files(folder: Path) -> list[bytes]:
    """Return points chosen of three shapes, in two draws."""
    from morphoskel.sampling.choice import Choice, write_choice

    indices = np.arange(12, dtype=np.int32).reshape(2, 3, 2) % 6
    choice = Choice(indices, np.full((2, 3), 2, dtype=np.int32))
    return written(folder / "seed.npz", lambda path: write_choice(choice, path))


def illustration_files(folder: Path) -> list[bytes]:
    """Return the smallest illustration."""
    from morphoskel.reporting.illustration import Illustration
    from morphoskel.reporting.illustration_file import write_illustration

    illustration = Illustration(
        name="pyramid", cloud=POINTS, surface=PYRAMID, mode="random", k=3, candidate_count=9, inner_count=6,
        candidates=POINTS, inside=np.array([True, False] * 3), inner=POINTS, udf=np.ones(6, np.float32),
        dilated=np.ones(6, np.float32), selected=np.array([0, 2]), residue_edges=np.array([0.0, 0.5, 1.0]),
        residue_counts=np.array([4, 2]),
    )  # fmt: skip
    return written(folder / "seed.npz", lambda path: write_illustration(path, illustration))
