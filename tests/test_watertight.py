import numpy as np
import pytest
import trimesh
from solids import ball, box, sphere_cloud, torus, two_components

from morphoskel.errors import ShapeError
from morphoskel.shapes import Mesh
from morphoskel.surface import reconstruct, watertight


def closed(mesh, **settings):
    result = watertight(mesh, **{"seed": 3, "resolution": 5000, **settings})
    return trimesh.Trimesh(result.vertices, result.triangles)


@pytest.mark.parametrize("mesh", [ball(subdivisions=3), box(2, 1, 0.2), torus(), two_components()])
def test_result_is_closed_oriented_and_not_smaller(mesh):
    before, after = trimesh.Trimesh(mesh.vertices, mesh.triangles), closed(mesh)
    assert after.is_watertight
    assert after.is_winding_consistent
    assert after.volume >= 0.995 * abs(before.volume)
    assert np.abs(np.array(after.bounds) - np.array(mesh.bounds)).max() < 0.06


def test_the_result_lies_outside_by_half_as_much_with_four_times_as_many_cells():
    few, many = (
        np.linalg.norm(closed(ball(subdivisions=5), resolution=leaves).vertices, axis=1).mean() - 1
        for leaves in (5000, 20_000)
    )
    assert many == pytest.approx(0.02, abs=0.002)
    assert few / many == pytest.approx(2, rel=0.1)


def test_an_open_sheet_becomes_a_thin_shell():
    """Stated in the docs: the inside of an open hemisphere is the gap between its two walls, not the bowl."""
    cloud = sphere_cloud(4000)
    bowl = reconstruct(type(cloud)(cloud.points[cloud.points[:, 2] > 0], cloud.normals[cloud.points[:, 2] > 0]),
                       "ball_pivoting")  # fmt: skip
    shell = closed(bowl)
    assert shell.is_watertight
    assert shell.volume < 0.15 * (2 / 3 * np.pi)


def test_scale_and_place_do_not_matter():
    """The native offset is absolute; without normalisation a small shape would swell out of all proportion."""
    mesh = torus()
    small = Mesh(mesh.vertices * 1e-3 + 5, mesh.triangles)
    assert closed(small).volume * 1e9 == pytest.approx(closed(mesh).volume, rel=1e-2)


def test_the_seed_decides():
    mesh = torus()
    first, second = (watertight(mesh, seed=2**62 + 1, resolution=3000) for _ in range(2))
    assert np.array_equal(first.vertices, second.vertices)
    assert np.array_equal(first.triangles, second.triangles)


def test_vertices_are_exact_in_single_precision():
    vertices = watertight(torus(), seed=1, resolution=3000).vertices
    assert np.array_equal(vertices, vertices.astype(np.float32))


def test_a_mesh_without_extent_is_refused():
    with pytest.raises(ShapeError, match="no extent"):
        watertight(Mesh(np.ones((3, 3)), [[0, 1, 2]]), seed=1)
