import numpy as np
import pytest
import trimesh
from coloured import SKELETON, all_parts

from morphoskel.errors import InputError
from morphoskel.exporting.coloured_parts import coloured_parts
from morphoskel.exporting.coloured_ply import write_coloured_ply
from morphoskel.formats import read_shape
from morphoskel.formats.ply import parse_ply_elements
from morphoskel.shapes import Mesh, Skeleton


@pytest.fixture
def path(tmp_path):
    write_coloured_ply(tmp_path / "a.ply", all_parts())
    return tmp_path / "a.ply"


def test_everything_is_in_the_file(path):
    parts = all_parts()
    elements = parse_ply_elements(path.read_bytes())
    vertex = elements["vertex"]
    for names, field in ((("x", "y", "z"), "vertices"), (("red", "green", "blue", "alpha"), "colours")):
        stacked = np.stack([vertex[name] for name in names], axis=1)
        expected = np.concatenate([getattr(part, field) for part in parts])
        np.testing.assert_array_equal(stacked, expected.astype(stacked.dtype))
    offset = sum(len(part.vertices) for part in parts[:2])
    assert elements["edge"]["vertex1"].tolist() == [offset, offset + 1]
    assert elements["edge"]["vertex2"].tolist() == [
        offset + 2,
        offset + 2,
    ]  # the centres that no edge uses are left out


def test_the_triangles_are_those_of_the_parts(path):
    mesh = read_shape(path)
    assert isinstance(mesh, Mesh)
    corners = mesh.vertices[mesh.triangles]
    expected = [part.vertices[part.elements] for part in all_parts() if part.normals is not None]
    np.testing.assert_allclose(corners, np.concatenate(expected), atol=1e-6)


def test_other_programs_see_the_colours(path):
    expected = np.concatenate([part.colours for part in all_parts()])
    mesh = trimesh.load(path, process=False)
    np.testing.assert_array_equal(mesh.visual.vertex_colors, expected)
    open3d = pytest.importorskip("open3d")
    other = open3d.io.read_triangle_mesh(str(path))
    np.testing.assert_allclose(np.asarray(other.vertex_colors), expected[:, :3] / 255, atol=1e-6)
    assert len(other.triangles) == len(mesh.faces)


def test_balls_alone_have_no_edges(tmp_path):
    write_coloured_ply(tmp_path / "b.ply", coloured_parts(Skeleton(SKELETON.points, SKELETON.radii)))
    assert "edge" not in parse_ply_elements((tmp_path / "b.ply").read_bytes())


def test_coordinates_beyond_float32_leave_no_file(tmp_path):
    far = coloured_parts(Skeleton(SKELETON.points + 1e39, SKELETON.radii), subdivisions=0)
    with pytest.raises(InputError, match=r"b\.ply: coordinates beyond the range"):
        write_coloured_ply(tmp_path / "b.ply", far)
    assert list(tmp_path.iterdir()) == []
