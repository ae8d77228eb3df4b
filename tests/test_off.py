import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.off import parse_off
from morphoskel.shapes import Mesh, PointCloud

VERTICES = b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n"
FACES = b"4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
BODY = VERTICES + FACES


@pytest.mark.parametrize(
    "content",
    [
        b"OFF\n5 5 8\n" + BODY,
        b"OFF5 5 8\n" + BODY,  # as in some files of ModelNet
        b"OFF 5 5 8\n" + BODY,
        b"OFF\n5 5\n" + BODY,
        b"OFF\r\n5 5 8\r\n" + BODY.replace(b"\n", b"\r\n"),
        b"# made by hand\nOFF\n\n# counts\n5 5 8\n\n" + BODY.replace(b"\n3 0", b" # base\n\n3 0"),
        b"COFF\n5 5 8\n" + VERTICES.replace(b"\n", b" 255 0 0 255\n") + FACES.replace(b"\n", b" 0 255 0\n"),
    ],
)
def test_a_pyramid_in_all_spellings(content):
    mesh = parse_off(content)
    assert isinstance(mesh, Mesh)
    np.testing.assert_array_equal(mesh.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]])
    expected = [[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    np.testing.assert_array_equal(mesh.triangles, expected)


def test_no_faces_make_a_cloud():
    cloud = parse_off(b"OFF\n5 0 0\n" + VERTICES)
    assert isinstance(cloud, PointCloud)
    assert cloud.normals is None


def test_normals_of_noff():
    cloud = parse_off(b"NOFF\n5 0 0\n" + VERTICES.replace(b"\n", b" 0 0 2\n"))
    np.testing.assert_array_equal(cloud.normals, np.tile([0, 0, 1], (5, 1)))


def test_every_missing_line_is_noticed():
    lines = (b"OFF\n5 5 8\n" + BODY).splitlines(keepends=True)
    for count in range(len(lines)):
        with pytest.raises(InputError):
            parse_off(b"".join(lines[:count]))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"OFF\n5 5 8\n" + VERTICES, "declares 5 vertices and 5 faces, but only 5 .*truncated"),
        (b"OFF\n5 5 8\n" + BODY + b"1 2 3\n", "line 13: the header declares"),
        (b"OFF\n5 5 8 7\n" + BODY, "line 2: expected the numbers"),
        (b"OFF\nfive 5 8\n" + BODY, "line 2: expected the number of vertices"),
        (b"OFF BINARY\n", "line 1: expected ASCII"),
        (b"STOFF\n5 5 8\n" + BODY, "line 1: expected ASCII"),
        (b"# nothing\n", "no data"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"3 3 0 4", b"3 3 0"), "line 12: expected 3 vertex indices"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"3 3 0 4", b"3 3 0 5"), "range of the vertices"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"3 3 0 4", b"2 3 0"), "face 4 has 2 corners"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"1 1 0", b"1 1"), "line 5: expected 3 numbers"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"1 1 0", b"1 1 z"), "line 5: expected only numbers"),
        (b"OFF\n5 5 8\n" + BODY.replace(b"1 1 0", b"1 1 nan"), "NaN"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_off(content)
