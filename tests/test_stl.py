import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.stl import parse_stl
from morphoskel.shapes import Mesh

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def binary_tetrahedron(start=b"solid in spite of being binary"):
    facets = np.zeros(4, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = POINTS[TRIANGLES]
    return start.ljust(80, b"\0") + np.uint32(4).tobytes() + facets.tobytes()


def ascii_tetrahedron():
    lines = ["solid tetrahedron"]
    for triangle in TRIANGLES:
        lines += ["facet normal 0 0 0", "  outer loop"]
        lines += [f"    vertex {' '.join(map(str, POINTS[corner]))}" for corner in triangle]
        lines += ["  endloop", "endfacet"]
    return "\n".join([*lines, "endsolid tetrahedron", ""]).encode()


@pytest.mark.parametrize(
    "content",
    [binary_tetrahedron(), binary_tetrahedron(b""), ascii_tetrahedron(), ascii_tetrahedron().replace(b"\n", b"\r\n")],
    ids=["binary", "unnamed", "ascii", "windows"],
)
def test_a_tetrahedron_has_four_shared_vertices(content):
    mesh = parse_stl(content)
    assert isinstance(mesh, Mesh)
    assert len(mesh.vertices) == 4
    np.testing.assert_array_equal(mesh.vertices[mesh.triangles], POINTS[TRIANGLES])


def test_every_truncation_of_a_binary_file_is_noticed():
    content = binary_tetrahedron()
    for length in range(1, len(content)):
        with pytest.raises(InputError):
            parse_stl(content[:length])


def test_every_missing_line_of_an_ascii_file_is_noticed():
    lines = ascii_tetrahedron().splitlines(keepends=True)
    for count in range(1, len(lines)):
        with pytest.raises(InputError):
            parse_stl(b"".join(lines[:count]))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (binary_tetrahedron() + b"x", "declares 4 facets, 284 bytes, but the file has 285"),
        (b"solid none\nendsolid none\n", "found none"),
        (ascii_tetrahedron().replace(b"    vertex 1.0 0.0 0.0\n", b"", 1), "4 facets need 12 vertex lines, .*has 11"),
        (ascii_tetrahedron().replace(b"vertex 1.0 0.0 0.0", b"vertex 1.0 0.0", 1), "expected 3 numbers"),
        (ascii_tetrahedron().replace(b"vertex 1.0 0.0 0.0", b"vertex 1.0 0.0 inf", 1), "infinite"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_stl(content)
