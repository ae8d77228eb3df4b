import numpy as np
import pytest
from coloured import SKELETON
from solids import as_mesh, ball, sphere_cloud

from morphoskel.reporting import scene_layers
from morphoskel.reporting.scene_layers import cloud_layer, feature_size_scalar, mesh_layer, skeleton_layers
from morphoskel.shapes import Mesh, Skeleton


def test_a_skeleton_shows_its_balls_and_keeps_the_rest_ready():
    balls, sheets, curves = skeleton_layers(SKELETON, "a")
    assert [layer.kind for layer in (balls, sheets, curves)] == ["balls", "mesh", "segments"]
    assert [layer.visible for layer in (balls, sheets, curves)] == [True, False, False]
    assert [scalar.values.tolist() for scalar in balls.scalars] == [SKELETON.radii.tolist(), SKELETON.residues.tolist()]
    assert (balls.name, balls.detail) == ("a", "4 balls")


def test_centres_without_radii_are_points_with_what_joins_them():
    layers = skeleton_layers(Skeleton(SKELETON.points, np.zeros(4), edges=SKELETON.edges))
    assert [(layer.kind, layer.visible) for layer in layers] == [("points", True), ("segments", True)]
    assert layers[0].scalars == []
    assert not any(layer.visible for layer in skeleton_layers(SKELETON, visible=False))


def test_a_large_cloud_is_thinned_and_says_so(monkeypatch):
    cloud = sphere_cloud(101)
    assert cloud_layer(cloud).detail == "101 points"
    monkeypatch.setattr(scene_layers, "MOST_POINTS", 50)
    layer = cloud_layer(cloud, sizes=np.arange(101.0))
    assert layer.detail == "34 of 101 points"
    np.testing.assert_array_equal(layer.positions, cloud.points[::3])
    np.testing.assert_array_equal(layer.scalars[0].values, np.arange(101)[::3])


def test_a_few_large_sizes_do_not_take_the_colours_from_the_rest():
    sizes = np.append(np.linspace(0, 1, 100), [50.0])
    assert 0.9 < feature_size_scalar(sizes, sizes).limits[1] < 1.1


def test_vertices_of_one_place_become_one_and_triangles_without_area_go():
    soup = ball(subdivisions=2)
    soup = Mesh(soup.vertices[soup.triangles].reshape(-1, 3), np.arange(3 * len(soup.triangles)).reshape(-1, 3))
    with_sliver = Mesh(soup.vertices, np.vstack([soup.triangles, [[0, 0, 1]]]))
    layer = mesh_layer(with_sliver)
    assert len(layer.positions) == 162
    assert len(layer.elements) == 320
    np.testing.assert_array_equal(layer.positions[layer.elements], soup.vertices[soup.triangles])
    assert layer.detail == "321 triangles"


def test_a_large_mesh_is_simplified_and_says_so():
    pytest.importorskip("open3d")
    layer = mesh_layer(ball(subdivisions=4), triangles=500)
    assert 300 < len(layer.elements) <= 500
    assert layer.detail == f"simplified from 5,120 to {len(layer.elements)} triangles"
    import trimesh

    assert as_mesh(trimesh.Trimesh(layer.positions, layer.elements)).bounds[1] == pytest.approx([1, 1, 1], abs=0.05)


def test_a_mesh_of_nothing_but_slivers_is_shown_as_it_is():
    flat = Mesh(np.eye(3), [[0, 0, 1]])
    assert len(mesh_layer(flat).elements) == 1
