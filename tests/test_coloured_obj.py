import numpy as np
import pytest
import trimesh
from coloured import SKELETON, all_parts

from morphoskel.errors import InputError
from morphoskel.exporting.coloured_obj import write_coloured_obj
from morphoskel.exporting.coloured_parts import coloured_parts
from morphoskel.formats import read_shape
from morphoskel.shapes import Mesh, Skeleton


@pytest.fixture
def path(tmp_path):
    write_coloured_obj(tmp_path / "a.obj", all_parts())
    return tmp_path / "a.obj"


def test_the_triangles_come_back_where_they_were(path):
    mesh = read_shape(path)
    assert isinstance(mesh, Mesh)
    expected = [part.vertices[part.elements] for part in all_parts() if part.normals is not None]
    np.testing.assert_allclose(mesh.vertices[mesh.triangles], np.concatenate(expected), atol=1e-7)


def test_each_part_is_an_object_with_its_own_vertices_normals_and_lines(path):
    """Follows the file line by line: numbers count from 1 over all objects."""
    parts = {part.name: part for part in all_parts()}
    found = {name: {"v": 0, "vn": 0, "f": 0, "l": 0} for name in parts}
    vertices, normals, name = [], [], None
    for keyword, *fields in map(str.split, path.read_text().splitlines()[1:]):
        if keyword == "o":
            name = fields[0]
            continue
        found[name][keyword] += 1
        if keyword == "v":
            vertices.append([float(field) for field in fields])
        elif keyword == "vn":
            normals.append([float(field) for field in fields])
        elif keyword == "f":
            for place, normal in (map(int, field.split("//")) for field in fields):
                part = parts[name]
                row = place - 1 - (len(vertices) - len(part.vertices))
                np.testing.assert_allclose(normals[normal - 1], part.normals[row], atol=1e-4)
                np.testing.assert_allclose(vertices[place - 1][3:], part.colours[row, :3] / 255, atol=1e-3)
        else:
            ends = [vertices[int(field) - 1][:3] for field in fields]
            np.testing.assert_allclose(ends, SKELETON.points[SKELETON.edges[found[name]["l"] - 1]], atol=1e-7)
    for name, part in parts.items():
        solid = part.normals is not None
        count = len(part.elements)
        assert found[name] == {
            "v": len(part.vertices), "vn": len(part.vertices) * solid, "f": count * solid, "l": count * (not solid)
        }  # fmt: skip


def test_trimesh_sees_the_colours_of_balls(tmp_path):
    parts = coloured_parts(Skeleton(SKELETON.points, SKELETON.radii), subdivisions=1)
    write_coloured_obj(tmp_path / "b.obj", parts)
    mesh = trimesh.load(tmp_path / "b.obj", process=False)
    assert len(mesh.faces) == 4 * 80
    np.testing.assert_allclose(mesh.visual.vertex_colors[:, :3], parts[0].colours[:, :3], atol=1)


def test_coordinates_beyond_float32_leave_no_file(tmp_path):
    far = coloured_parts(Skeleton(SKELETON.points + 1e39, SKELETON.radii), subdivisions=0)
    with pytest.raises(InputError, match=r"b\.obj: coordinates beyond the range"):
        write_coloured_obj(tmp_path / "b.obj", far)
    assert list(tmp_path.iterdir()) == []
