import json
import struct

import numpy as np
import pytest
import trimesh
from coloured import SKELETON, all_parts

from morphoskel.errors import InputError
from morphoskel.exporting.coloured_parts import coloured_parts
from morphoskel.exporting.glb import to_linear, write_glb
from morphoskel.shapes import Skeleton


@pytest.fixture
def path(tmp_path):
    write_glb(tmp_path / "a.glb", all_parts())
    return tmp_path / "a.glb"


def header(path):
    """The JSON of a GLB file, read by the specification: magic, version, length, then chunks."""
    content = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack_from("<I4s", content, 12)
    assert kind == b"JSON"
    return json.loads(content[20 : 20 + size])


def test_each_part_is_a_named_node_with_a_mesh(path):
    tree = header(path)
    named = {node["name"]: tree["meshes"][node["mesh"]]["primitives"][0] for node in tree["nodes"] if "mesh" in node}
    assert set(named) == {"balls", "sheets", "curves", "surface"}
    assert {name: primitive.get("mode", 4) for name, primitive in named.items()} == {
        "balls": 4, "sheets": 4, "curves": 1, "surface": 4
    }  # fmt: skip
    for name in ("balls", "sheets", "surface"):
        assert {"POSITION", "NORMAL", "COLOR_0"} <= named[name]["attributes"].keys()
    materials = {name: tree["materials"][primitive["material"]] for name, primitive in named.items()}
    assert materials["surface"]["alphaMode"] == "BLEND"
    assert materials["balls"]["alphaMode"] == "OPAQUE"
    for name in ("balls", "sheets", "surface"):
        assert materials[name]["pbrMetallicRoughness"]["metallicFactor"] == 0


def test_triangles_and_colours_come_back(path):
    scene = trimesh.load(path)
    for part in all_parts():
        if part.normals is None:
            continue
        mesh = scene.geometry[part.name]
        np.testing.assert_allclose(mesh.vertices[mesh.faces], part.vertices[part.elements], atol=1e-6)
        colours = mesh.visual.vertex_attributes["color"]
        np.testing.assert_array_equal(colours[mesh.faces], to_linear(part.colours)[part.elements])


def test_segments_come_back(path):
    accessor = header(path)
    [curves] = [mesh for mesh in accessor["meshes"] if mesh["name"] == "curves"]
    assert accessor["accessors"][curves["primitives"][0]["attributes"]["POSITION"]]["count"] == 2 * len(SKELETON.edges)


def test_linear_colours_follow_the_standard():
    colours = np.array([[0, 10, 255, 77], [188, 128, 64, 255]], dtype=np.uint8)
    expected = [[0, round(255 * 10 / 255 / 12.92), 255, 77], [128, 55, 13, 255]]
    np.testing.assert_allclose(to_linear(colours), expected, atol=1)
    assert to_linear(colours)[:, 3].tolist() == [77, 255]


def test_coordinates_beyond_float32_leave_no_file(tmp_path):
    far = coloured_parts(Skeleton(SKELETON.points + 1e39, SKELETON.radii), subdivisions=0)
    with pytest.raises(InputError, match=r"b\.glb: coordinates beyond the range"):
        write_glb(tmp_path / "b.glb", far)
    assert list(tmp_path.iterdir()) == []
