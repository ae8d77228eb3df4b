import io

import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.numpy_arrays import parse_npy, parse_npz
from morphoskel.shapes import Mesh

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float32)
NORMALS = np.array([[0, 0, 2], [0, 0, 0], [1, 0, 0], [0, 1, 0]])


def npy(array):
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def npz(**arrays):
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def test_npy_with_points_and_with_normals():
    np.testing.assert_array_equal(parse_npy(npy(POINTS)).points, POINTS)
    cloud = parse_npy(npy(np.hstack([POINTS, NORMALS])))
    np.testing.assert_array_equal(cloud.normals, np.sign(NORMALS))


def test_npz_of_a_cloud():
    cloud = parse_npz(npz(points=POINTS, normals=NORMALS, labels=np.arange(4, dtype=np.uint8)))
    np.testing.assert_array_equal(cloud.points, POINTS)
    np.testing.assert_array_equal(cloud.normals, np.sign(NORMALS))
    np.testing.assert_array_equal(cloud.labels, range(4))


def test_npz_of_a_mesh():
    mesh = parse_npz(npz(vertices=POINTS, triangles=[[0, 1, 2], [0, 2, 3]]))
    assert isinstance(mesh, Mesh)
    np.testing.assert_array_equal(mesh.triangles, [[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize("content", [npy(POINTS), npz(points=POINTS)], ids=["npy", "npz"])
def test_every_truncation_is_noticed(content):
    parse = parse_npz if content.startswith(b"PK") else parse_npy
    for length in range(1, len(content)):
        with pytest.raises(InputError):
            parse(content[:length])


@pytest.mark.parametrize(
    ("parse", "content", "message"),
    [
        (parse_npy, npy(np.ones(4)), r"shape \(N, 3\) or \(N, 6\), got \(4,\)"),
        (parse_npy, npy(np.ones((4, 5))), "got 5"),
        (parse_npy, npy(np.array(["a", "b"])), "expected numbers, got"),
        (parse_npy, npy(POINTS * np.nan), "NaN"),
        (parse_npy, npz(points=POINTS), "NPY file"),
        (parse_npz, npy(POINTS), "NPZ file"),
        (parse_npz, npz(cloud=POINTS), "the file holds cloud"),
        (parse_npz, npz(points=POINTS[:, :2]), r"points: expected shape \(N, 3\)"),
        (parse_npz, npz(points=POINTS, labels=np.ones((4, 1))), "labels: expected shape"),
        (parse_npz, npz(points=POINTS, normals=NORMALS[:3]), "normals: expected 4 rows"),
        (parse_npz, npz(points=POINTS, normals=np.ones(4)), r"normals: expected shape \(N, 3\)"),
        (parse_npz, npz(points=np.array(["a"])), "points"),
        (parse_npz, npz(vertices=POINTS, triangles=[[0, 1]]), r"triangles: expected shape \(T, 3\)"),
        (parse_npz, npz(vertices=POINTS, triangles=[[0, 1, 0.5]]), "triangles: expected whole numbers"),
        (parse_npz, npz(vertices=POINTS, triangles=[[0, 1, 4]]), "range of the vertices"),
    ],
)
def test_damage_is_reported(parse, content, message):
    with pytest.raises(InputError, match=message):
        parse(content)


def test_pickled_objects_are_never_loaded():
    stream = io.BytesIO()
    np.save(stream, np.array([{"a": 1}]), allow_pickle=True)
    with pytest.raises(InputError, match="expected numbers or text"):
        parse_npy(stream.getvalue())
