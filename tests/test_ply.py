import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.ply import parse_ply, parse_ply_elements
from morphoskel.formats.ply_body import RaggedList
from morphoskel.shapes import Mesh, PointCloud

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]], dtype=np.float64)
FACES = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]


def header(kind, *lines):
    return "\n".join(["ply", f"format {kind} 1.0", "comment made for a test", *lines, "end_header", ""]).encode()


def vertex_lines(count=5, extra=()):
    return [f"element vertex {count}", *(f"property float {axis}" for axis in "xyz"), *extra]


def ascii_pyramid(faces=FACES, vertices=5, declared_faces=None):
    body = [" ".join(f"{value:g}" for value in row) for row in POINTS[:vertices]]
    body += [" ".join(map(str, (len(face), *face))) for face in faces]
    lines = [*vertex_lines(), f"element face {declared_faces or len(FACES)}", "property list uchar int vertex_indices"]
    return header("ascii", *lines) + ("\n".join(body) + "\n").encode()


def binary_pyramid(order, faces=FACES, face_scalar=False):
    kind = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    lines = [*vertex_lines(), f"element face {len(faces)}", "property list uchar int vertex_index"]
    body = POINTS.astype(f"{order}f4").tobytes()
    for face in faces:
        body += bytes([len(face)]) + np.array(face, dtype=f"{order}i4").tobytes() + (b"\7" if face_scalar else b"")
    return header(kind, *lines, *(["property uchar quality"] if face_scalar else [])) + body


@pytest.mark.parametrize(
    "content",
    [
        ascii_pyramid(),
        ascii_pyramid().replace(b"\n", b"\r\n"),
        ascii_pyramid().replace(b"1 1 0\n", b"1 1 0 \n\n"),
        binary_pyramid("<"),
        binary_pyramid(">"),
        binary_pyramid(">", face_scalar=True),
    ],
    ids=["ascii", "windows", "blank line", "little", "big", "face scalar"],
)
def test_a_pyramid_with_a_square_base_in_all_kinds(content):
    mesh = parse_ply(content)
    assert isinstance(mesh, Mesh)
    np.testing.assert_array_equal(mesh.vertices, POINTS)
    expected = [[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    np.testing.assert_array_equal(mesh.triangles, expected)


def test_triangles_only_are_read_at_once_with_the_same_result():
    mesh = parse_ply(binary_pyramid("<", FACES[1:], face_scalar=True))
    np.testing.assert_array_equal(mesh.triangles, FACES[1:])


def test_a_square_among_triangles_is_not_overlooked():
    mesh = parse_ply(binary_pyramid("<", FACES[::-1]))
    np.testing.assert_array_equal(mesh.triangles, [*FACES[:0:-1], (0, 3, 2), (0, 2, 1)])


def test_header_with_windows_line_ends_before_binary_data():
    content = binary_pyramid("<")
    end = content.index(b"end_header\n") + len(b"end_header\n")
    assert len(parse_ply(content[:end].replace(b"\n", b"\r\n") + content[end:]).triangles) == 6


def test_cloud_with_normals_and_labels():
    extra = [*(f"property float n{axis}" for axis in "xyz"), "property int label", "property uchar red"]
    rows = ["0 0 0 0 0 2 7 255", "1 0 0 0 0 0 8 255", "1 1 0 1 0 0 9 255", "0 1 0 0 1 0 7 255", "0 0 1 0 0 -1 7 0"]
    cloud = parse_ply(header("ascii", *vertex_lines(5, extra)) + "\n".join(rows).encode())
    assert isinstance(cloud, PointCloud)
    np.testing.assert_array_equal(cloud.normals, [[0, 0, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, -1]])
    np.testing.assert_array_equal(cloud.labels, [7, 8, 9, 7, 7])


def test_no_faces_make_a_cloud():
    content = header("ascii", *vertex_lines(), "element face 0", "property list uchar int vertex_indices")
    assert isinstance(parse_ply(content + b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n"), PointCloud)


def test_other_elements_are_read_past():
    lines = ["element camera 1", "property double view", *vertex_lines(), "element edge 1", "property list int int v"]
    body = np.array([1.0]).tobytes() + POINTS.astype("<f4").tobytes() + np.array([2, 0, 1], dtype="<i4").tobytes()
    content = header("binary_little_endian", *lines) + body
    assert len(parse_ply(content)) == 5
    edge = parse_ply_elements(content)["edge"]["v"]
    assert isinstance(edge, RaggedList)
    np.testing.assert_array_equal(edge.values, [0, 1])


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("faces", [FACES, FACES[1:]], ids=["ragged", "triangles"])
def test_every_truncation_of_a_binary_file_is_noticed(order, faces):
    content = binary_pyramid(order, faces)
    for length in range(len(content)):
        with pytest.raises(InputError):
            parse_ply(content[:length])


def test_every_missing_line_of_an_ascii_file_is_noticed():
    lines = ascii_pyramid().splitlines(keepends=True)
    for count in range(len(lines)):
        with pytest.raises(InputError):
            parse_ply(b"".join(lines[:count]))


def test_truncation_tells_declared_and_found():
    with pytest.raises(InputError, match=r"declares 5 vertex and 5 face lines, 10 in all, but 6 follow; .*truncated"):
        parse_ply(ascii_pyramid(FACES[:1]))


def test_more_than_declared_is_noticed():
    with pytest.raises(InputError, match="10 in all, but 11 follow"):
        parse_ply(ascii_pyramid() + b"9 9 9\n")
    with pytest.raises(InputError, match="4 bytes follow after"):
        parse_ply(binary_pyramid("<") + b"1234")
    assert isinstance(parse_ply(binary_pyramid("<") + b"\n"), Mesh)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"solid x", "first line is 'ply'"),
        (header("ascii", "element vertex many"), "line 4: expected the number of vertex, got 'many'"),
        (header("ascii", "property float x"), "line 4: not a legal line"),
        (header("ascii", "element vertex 1", "property quad x"), "line 5: not a legal line"),
        (header("binary", "element vertex 0"), "line 2: not a legal line"),
        (b"ply\nelement vertex 0\nend_header\n", "no line 'format"),
        (header("ascii", "element point 1", "property int x") + b"1\n", "vertex properties x, y, z; the file has none"),
        (header("ascii", *vertex_lines(1)) + b"1 2 nought\n", "line 9: expected only numbers"),
        (header("ascii", *vertex_lines(1)) + b"1 2\n", "line 9: expected 3 numbers, got 2"),
        (header("ascii", *vertex_lines(1, ["property int x"])) + b"1 2 3 4\n", "a name twice among x, y, z, x"),
        (header("ascii", "element a 0", "element a 0"), "a name twice among a, a"),
        (ascii_pyramid([*FACES[:4], (3, 0, 9)]), "range of the vertices"),
        (ascii_pyramid([*FACES[:4], (3, 0)]), "face 4 has 2 corners"),
        (ascii_pyramid([*FACES[:4], (3, 0, 4)]).replace(b"3 3 0 4", b"4 3 0 4"), "line 20: does not match"),
        (ascii_pyramid([*FACES[:4], (3, 0, 4)]).replace(b"3 3 0 4", b"3 3 0 4 1"), "line 20: does not match"),
        (ascii_pyramid().replace(b"3 3 0 4", b"3 3 0 4.5"), "whole numbers"),
        (ascii_pyramid().replace(b"0.5 0.5 1", b"0.5 nan 1"), "NaN"),
        (ascii_pyramid().replace(b"vertex_indices", b"corner"), "not lists named vertex_indices"),
        (
            header("ascii", *vertex_lines(4), "element face 1", "property int vertex_index") + b"0 0 0\n" * 4 + b"0\n",
            "not lists named vertex_indices",
        ),
        (
            header("ascii", *vertex_lines(5), "element tristrips 0", "property int n") + b"0 0 0\n" * 5,
            "plain triangles",
        ),
        (header("ascii", *vertex_lines(5)) + b"0 0 0\n" * 5, "distinct"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_ply(content)


def test_a_negative_list_length_is_reported():
    content = binary_pyramid("<").replace(b"list uchar", b"list char")
    damaged = bytearray(content)
    damaged[content.index(b"end_header\n") + len(b"end_header\n") + 60] = 255
    with pytest.raises(InputError, match="has the length -1"):
        parse_ply(bytes(damaged))
