import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.obj import parse_obj
from morphoskel.shapes import Mesh, PointCloud

VERTICES = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n"
FACES = b"f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"


@pytest.mark.parametrize(
    "content",
    [
        VERTICES + FACES,
        (VERTICES + FACES).replace(b"\n", b"\r\n"),
        b"# by hand\nmtllib a.mtl\no pyramid\n"
        + VERTICES
        + b"vt 0 0\nusemtl red\ng sides\ns off\n"
        + FACES
        + b"l 1 2\n",
        VERTICES.replace(b"\n", b" 0.1 0.2 0.3\n") + FACES,  # colours
        VERTICES + FACES.replace(b"f 1 2 5", b"f 1/1 2/1 5/1").replace(b"f 2 3 5", b"f 2//1 3//2 5//1"),
        VERTICES + FACES.replace(b"f 1 2 5", b"f -5 -4 -1"),
        VERTICES + FACES.replace(b"f 1 2 5", b"f 1 \\\n2 5"),
    ],
    ids=["plain", "windows", "extras", "colours", "slashes", "negative", "continued"],
)
def test_a_pyramid_in_all_spellings(content):
    mesh = parse_obj(content)
    assert isinstance(mesh, Mesh)
    np.testing.assert_array_equal(mesh.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]])
    expected = [[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    np.testing.assert_array_equal(mesh.triangles, expected)


def test_negative_numbers_count_from_the_vertex_read_last():
    mesh = parse_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -3 -2 -1\n")
    np.testing.assert_array_equal(mesh.triangles, [[0, 1, 2], [1, 2, 3]])


def test_no_faces_make_a_cloud_with_normals_if_there_is_one_for_each_vertex():
    cloud = parse_obj(VERTICES + b"vn 0 0 2\n" * 5)
    assert isinstance(cloud, PointCloud)
    np.testing.assert_array_equal(cloud.normals, np.tile([0, 0, 1], (5, 1)))
    assert parse_obj(VERTICES + b"vn 0 0 2\n" * 4).normals is None


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"# nothing\n", "found none"),
        (VERTICES + FACES + b"f 4 1", "face 5 has 2 corners"),
        (VERTICES[:-4] + b"\n" + FACES, "line 5: expected three numbers"),
        (VERTICES + b"f 1 2 x\n", "line 6: expected vertex numbers"),
        (VERTICES + b"f 0 1 2\n", "line 6: vertex number 0 does not exist"),
        (VERTICES + b"f -9 1 2\n", "line 6: vertex number -9 does not exist"),
        (VERTICES[:24] + FACES, "range of the vertices"),
        (VERTICES + b"curv 0 1 1 2\n", "line 6: expected OBJ vertices and faces"),
        (VERTICES + b"v 1 2 three\n", "line 6: expected only numbers"),
        (VERTICES + b"v 1 2 inf\n", "infinite"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_obj(content)
