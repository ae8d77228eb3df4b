import numpy as np
import pytest
import trimesh

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply, write_mesh_ply
from morphoskel.reporting.illustrated_shapes import BOX, NAMED_SHAPES, RING, TUBE, named_shape, shape_from
from morphoskel.shapes import Mesh, PointCloud


@pytest.mark.parametrize("name", NAMED_SHAPES)
def test_named_shapes_are_closed_and_within_the_unit_ball(name):
    mesh = named_shape(name)
    assert trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).is_watertight
    assert np.linalg.norm(mesh.vertices, axis=1).max() == pytest.approx(1.0, abs=1e-6)


def test_the_torus_stands_with_its_axis_along_z():
    x, y, z = named_shape("torus").vertices.T
    assert np.allclose((np.hypot(x, y) - RING) ** 2 + z**2, TUBE**2, atol=1e-6)


def test_the_box_has_its_proportions():
    lower, upper = named_shape("box").bounds
    assert np.allclose((upper - lower) / (upper - lower)[0], np.array(BOX) / BOX[0])


def test_an_unknown_name_is_refused(tmp_path):
    with pytest.raises(InputError, match="no shape is called 'cube'"):
        named_shape("cube")
    with pytest.raises(InputError, match="neither a file nor one of dragon"):
        shape_from(tmp_path / "missing.ply", generator=np.random.default_rng(0))


def test_a_file_takes_the_place_of_a_named_shape(tmp_path):
    box = named_shape("box")
    write_mesh_ply(tmp_path / "mine.ply", box)
    shape = shape_from(str(tmp_path / "mine.ply"), generator=np.random.default_rng(0))
    assert isinstance(shape, Mesh)
    assert np.allclose(shape.vertices, box.vertices)


def test_points_are_drawn_on_a_mesh_and_a_cloud_is_left_as_it_is(tmp_path):
    cloud = shape_from("box", samples=300, generator=np.random.default_rng(0))
    assert isinstance(cloud, PointCloud)
    assert cloud.normals is not None
    half = named_shape("box").bounds[1]
    assert np.allclose(np.abs(cloud.points / half).max(axis=1), 1)  # on a face
    write_cloud_ply(tmp_path / "cloud.ply", cloud)
    read = shape_from(tmp_path / "cloud.ply", samples=7, generator=np.random.default_rng(0))
    assert len(read) == 300


def test_a_file_may_be_called_like_a_named_shape(tmp_path):
    write_mesh_ply(tmp_path / "torus.ply", named_shape("box"))
    shape = shape_from(tmp_path / "torus.ply", generator=np.random.default_rng(0))
    assert len(shape.vertices) == 8
