import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from morphoskel.errors import InputError
from morphoskel.formats.read import read_shape
from morphoskel.formats.skeleton_file import read_skeleton
from morphoskel.formats.write import (
    read_skeleton_ply,
    write_cloud_ply,
    write_mesh_ply,
    write_skeleton_npz,
    write_skeleton_ply,
)
from morphoskel.shapes import Mesh, PointCloud, Skeleton

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)
FLOAT32 = st.floats(-1e6, 1e6, width=32)


@pytest.fixture
def cloud():
    generator = np.random.default_rng(4)
    normals = generator.normal(size=(100, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normals[7] = 0
    return PointCloud(generator.normal(size=(100, 3)), normals, generator.integers(-3, 50, 100))


@st.composite
def clouds(draw):
    count = draw(st.integers(0, 20))
    points = np.vstack([CORNERS, draw(arrays(np.float32, (count, 3), elements=FLOAT32))])
    normals = labels = None
    if draw(st.booleans()):
        normals = np.eye(3)[draw(arrays(np.int64, count + 4, elements=st.integers(0, 2)))]
        normals[draw(arrays(np.bool_, count + 4))] = 0
    if draw(st.booleans()):
        labels = draw(arrays(np.int64, count + 4, elements=st.integers(-(2**31) + 1, 2**31 - 1)))
    return PointCloud(points, normals, labels)


@settings(max_examples=60, deadline=None)
@given(clouds())
def test_clouds_with_float32_values_come_back_exactly(tmp_path_factory, cloud):
    path = tmp_path_factory.mktemp("round_trip") / "cloud.ply"
    write_cloud_ply(path, cloud)
    back = read_shape(path)
    np.testing.assert_array_equal(back.points, cloud.points)
    for name in ("normals", "labels"):
        before, after = getattr(cloud, name), getattr(back, name)
        assert (before is None) == (after is None)
        if before is not None:
            np.testing.assert_array_equal(after, before)


@settings(max_examples=60, deadline=None)
@given(
    arrays(np.float32, (5, 3), elements=FLOAT32),
    arrays(np.int64, st.tuples(st.integers(1, 20), st.just(3)), elements=st.integers(0, 8)),
)
def test_meshes_with_float32_values_come_back_exactly(tmp_path_factory, more, triangles):
    path = tmp_path_factory.mktemp("round_trip") / "mesh.ply"
    mesh = Mesh(np.vstack([CORNERS, more]), triangles)
    write_mesh_ply(path, mesh)
    back = read_shape(path)
    assert isinstance(back, Mesh)
    np.testing.assert_array_equal(back.vertices, mesh.vertices)
    np.testing.assert_array_equal(back.triangles, mesh.triangles)


@settings(max_examples=60, deadline=None)
@given(arrays(np.float64, st.tuples(st.integers(0, 10), st.just(5)), elements=st.floats(0, 1e300)))
def test_skeletons_come_back_exactly(tmp_path_factory, table):
    path = tmp_path_factory.mktemp("round_trip") / "skeleton.ply"
    skeleton = Skeleton(-table[:, :3], table[:, 3], table[:, 4])
    write_skeleton_ply(path, skeleton)
    back = read_skeleton_ply(path)
    for name in ("points", "radii", "residues"):
        np.testing.assert_array_equal(getattr(back, name), getattr(skeleton, name))


@settings(max_examples=40, deadline=None)
@given(
    arrays(np.float64, (6, 5), elements=st.floats(0, 1e300)),
    arrays(np.int64, st.tuples(st.integers(0, 5), st.just(2)), elements=st.integers(0, 5)),
    arrays(np.int64, st.tuples(st.integers(0, 5), st.just(3)), elements=st.integers(0, 5)),
    st.booleans(),
)
def test_parts_of_skeletons_come_back_exactly(tmp_path_factory, table, edges, triangles, ranked):
    folder = tmp_path_factory.mktemp("round_trip")
    skeleton = Skeleton(table[:, :3], table[:, 3], table[:, 4] if ranked else None, edges, triangles)
    for name, write in (("a.ply", write_skeleton_ply), ("a.npz", write_skeleton_npz)):
        write(folder / name, skeleton)
        back = read_skeleton(folder / name)
        for field in ("points", "radii", "residues", "edges", "triangles"):
            before, after = getattr(skeleton, field), getattr(back, field)
            assert (before is None) == (after is None)
            if before is not None:
                np.testing.assert_array_equal(after, before)


def test_clouds_open_in_other_programs(tmp_path, cloud):
    path = tmp_path / "cloud.ply"
    write_cloud_ply(path, cloud)
    trimesh = pytest.importorskip("trimesh")
    np.testing.assert_allclose(trimesh.load(path).vertices, cloud.points, atol=1e-6)
    open3d = pytest.importorskip("open3d")
    other = open3d.io.read_point_cloud(str(path))
    np.testing.assert_allclose(np.asarray(other.points), cloud.points, atol=1e-6)
    np.testing.assert_allclose(np.asarray(other.normals), cloud.normals, atol=1e-6)


def test_meshes_open_in_other_programs(tmp_path):
    path = tmp_path / "mesh.ply"
    mesh = Mesh(CORNERS, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
    write_mesh_ply(path, mesh)
    trimesh = pytest.importorskip("trimesh")
    other = trimesh.load(path, process=False)
    np.testing.assert_array_equal(other.vertices, mesh.vertices)
    np.testing.assert_array_equal(other.faces, mesh.triangles)
    assert other.volume == pytest.approx(1 / 6)
    open3d = pytest.importorskip("open3d")
    other = open3d.io.read_triangle_mesh(str(path))
    np.testing.assert_array_equal(np.asarray(other.vertices), mesh.vertices)
    np.testing.assert_array_equal(np.asarray(other.triangles), mesh.triangles)


def test_skeletons_open_in_other_programs(tmp_path):
    path = tmp_path / "skeleton.ply"
    write_skeleton_ply(path, Skeleton(CORNERS, np.arange(4.0), np.zeros(4)))
    trimesh = pytest.importorskip("trimesh")
    np.testing.assert_array_equal(trimesh.load(path).vertices, CORNERS)
    open3d = pytest.importorskip("open3d")
    np.testing.assert_array_equal(np.asarray(open3d.io.read_point_cloud(str(path)).points), CORNERS)
    radii = open3d.t.io.read_point_cloud(str(path)).point["radius"].numpy()
    np.testing.assert_array_equal(radii[:, 0], np.arange(4.0))


def test_skeleton_as_arrays(tmp_path):
    skeleton = Skeleton(CORNERS, np.arange(4.0), np.zeros(4))
    paths = [tmp_path / "one.npz", tmp_path / "two.npz"]
    for path in paths:
        write_skeleton_npz(path, skeleton)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    with np.load(paths[0]) as arrays_read:
        np.testing.assert_array_equal(arrays_read["points"], CORNERS)
        np.testing.assert_array_equal(arrays_read["radii"], range(4))
        np.testing.assert_array_equal(arrays_read["residues"], 0)


def test_what_float32_or_int32_cannot_hold_is_refused_and_leaves_no_file(tmp_path):
    path = tmp_path / "shape.ply"
    with pytest.raises(InputError, match=r"shape\.ply: .*range of float32"):
        write_cloud_ply(path, PointCloud(CORNERS * 1e39))
    with pytest.raises(InputError, match="range of float32"):
        write_mesh_ply(path, Mesh(CORNERS * 1e39, np.array([[0, 1, 2]])))
    with pytest.raises(InputError, match=r"shape\.ply: .*float32 resolves"):
        write_cloud_ply(path, PointCloud(CORNERS + 1e9))
    with pytest.raises(InputError, match="labels must fit into 32 bits"):
        write_cloud_ply(path, PointCloud(CORNERS, labels=np.arange(4) + 2**31))
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_skeleton(tmp_path, cloud):
    with pytest.raises(InputError, match=r"absent\.ply: cannot be read"):
        read_skeleton_ply(tmp_path / "absent.ply")
    path = tmp_path / "cloud.ply"
    write_cloud_ply(path, cloud)
    with pytest.raises(InputError, match=r"cloud\.ply: expected the vertex properties .*radius"):
        read_skeleton_ply(path)
    write_skeleton_ply(path, Skeleton(CORNERS, np.arange(4.0), np.zeros(4)))
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(InputError, match="truncated"):
        read_skeleton_ply(path)


def test_connected_skeleton_without_residues_comes_back(tmp_path):
    skeleton = Skeleton(CORNERS, np.arange(4.0), edges=[[0, 3]], triangles=[[0, 1, 2], [1, 2, 3]])
    write_skeleton_ply(tmp_path / "a.ply", skeleton)
    read = read_skeleton_ply(tmp_path / "a.ply")
    assert read.residues is None
    for name in ("points", "radii", "edges", "triangles"):
        assert np.array_equal(getattr(read, name), getattr(skeleton, name))
