import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.shapes import Mesh, PointCloud, Skeleton

TETRAHEDRON = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def test_cloud_accepts_four_distinct_points():
    cloud = PointCloud(TETRAHEDRON, normals=np.zeros((4, 3)), labels=np.arange(4))
    assert len(cloud) == 4
    assert repr(cloud) == "PointCloud(4 points, normals, labels)"


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.repeat(TETRAHEDRON[:3], 50, axis=0), "3 of them distinct"),
        (np.zeros((0, 3)), "0 points"),
        (np.zeros((5, 2)), r"expected shape \(N, 3\)"),
        (np.vstack([TETRAHEDRON, [[0, np.nan, 0]]]), "first is row 4"),
        (np.vstack([TETRAHEDRON, [[0, np.inf, 0]]]), "NaN or infinite"),
    ],
)
def test_cloud_refuses(points, message):
    with pytest.raises(InputError, match=message):
        PointCloud(points)


@pytest.mark.parametrize("extra", [{"normals": np.zeros((3, 3))}, {"labels": np.zeros(3)}])
def test_cloud_refuses_extras_of_another_length(extra):
    with pytest.raises(InputError, match="one a point"):
        PointCloud(TETRAHEDRON, **extra)


@pytest.mark.parametrize("triangles", [[[0, 1, 4]], [[-1, 1, 2]], np.zeros((0, 3)), [[0, 1]]])
def test_mesh_refuses(triangles):
    with pytest.raises(InputError, match="triangles"):
        Mesh(TETRAHEDRON, np.asarray(triangles))


def test_bounds_ignore_vertices_of_no_triangle():
    mesh = Mesh(np.vstack([TETRAHEDRON, [[9, 9, 9]]]), [[0, 1, 2], [0, 1, 3]])
    assert mesh.bounds[1].tolist() == [1, 1, 1]


@pytest.mark.parametrize("field", ["radii", "residues"])
@pytest.mark.parametrize("values", [[1.0, -1e-9], [1.0, np.nan], [1.0]])
def test_skeleton_refuses(field, values):
    arrays = {"points": np.zeros((2, 3)), "radii": np.ones(2), "residues": np.zeros(2), field: values}
    with pytest.raises(InputError, match=field):
        Skeleton(**arrays)


def test_an_empty_skeleton_describes_itself():
    assert repr(Skeleton(np.zeros((0, 3)), np.zeros(0), np.zeros(0))) == "Skeleton(0 balls)"


@pytest.mark.parametrize(("part", "value"), [("edges", [[0, 3]]), ("triangles", [[0, 1]]), ("edges", [[-1, 0]])])
def test_skeleton_refuses_connections_between_centres_that_it_does_not_have(part, value):
    with pytest.raises(InputError, match=part):
        Skeleton(np.zeros((3, 3)), np.zeros(3), **{part: value})
