import numpy as np
import pytest
import trimesh

from morphoskel.datasets.synthetic import CATEGORIES
from morphoskel.datasets.synthetic.catalogue import find_builder
from morphoskel.datasets.synthetic.dragon import build_dragon, dragon
from morphoskel.volume import Candidates, SurfaceDistance, occupancy


@pytest.fixture(scope="module")
def mesh():
    return dragon()


@pytest.fixture(scope="module")
def measured(mesh):
    """Points inside and their distance to the surface."""
    inner = occupancy(mesh, Candidates(*mesh.bounds, 60_000, seed=1)).inner_points()
    return inner, SurfaceDistance(mesh)(inner)


def test_the_surface_is_one_watertight_piece_without_handles(mesh):
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.body_count == 1
    assert 0.1 < solid.volume < 0.3
    assert (solid.area_faces > 0).all()


def test_it_is_normalised_like_the_shapes_of_the_categories(mesh):
    lower, upper = mesh.bounds
    assert np.allclose(lower, -upper, atol=1e-6)
    assert np.linalg.norm(mesh.vertices, axis=1).max() == pytest.approx(1.0, abs=1e-6)
    assert np.array_equal(mesh.vertices, mesh.vertices.astype(np.float32))


def test_it_is_the_same_every_time(mesh):
    again = dragon()
    assert again.vertices.tobytes() == mesh.vertices.tobytes()
    assert again.triangles.tobytes() == mesh.triangles.tobytes()


def test_the_trunk_is_thick_and_the_wings_are_thin(measured):
    inner, udf = measured
    wing = (np.abs(inner[:, 0]) > 0.28) & (inner[:, 1] > 0.15)
    assert wing.sum() > 100
    assert udf[wing].max() < 0.04
    assert udf.max() > 0.17
    assert np.abs(inner[udf.argmax(), 0]) < 0.05  # in the middle of the trunk


def test_the_head_is_in_front_and_up_and_every_part_comes_in_its_number(mesh, measured):
    inner, _ = measured
    front = inner[inner[:, 2] < -0.75]
    assert len(front) > 5
    assert front[:, 1].min() > 0.15  # no leg or tail reaches as far
    names = [part.name for part in build_dragon()]
    assert {name: names.count(name) for name in ("trunk", "head", "leg", "wing")} == {
        "trunk": 1,
        "head": 1,
        "leg": 4,
        "wing": 2,
    }
    assert names.count("spike") > 8


def test_it_is_no_category():
    assert not any(find_builder(category).__module__.endswith("dragon") for category in CATEGORIES)
