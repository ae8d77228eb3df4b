import numpy as np
import pytest
import trimesh

from morphoskel.errors import InputError
from morphoskel.shapes import Skeleton
from morphoskel.skeleton.ball_mesh import ball_mesh, subdivisions_within

BALLS = Skeleton([[0.0, 0, 0], [3, 1, -2], [3.1, 1, -2]], [1.0, 0.25, 0.0])


def ball_mesh_naive(skeleton, subdivisions):
    """One icosphere after the other."""
    return trimesh.util.concatenate(
        [
            trimesh.creation.icosphere(subdivisions=subdivisions, radius=1)
            .apply_scale(radius)
            .apply_translation(centre)
            if radius
            else trimesh.Trimesh(
                np.tile(centre, (10 * 4**subdivisions + 2, 1)),
                trimesh.creation.icosphere(subdivisions=subdivisions).faces,
                process=False,
            )
            for centre, radius in zip(skeleton.points, skeleton.radii, strict=True)
        ]
    )


@pytest.mark.parametrize("subdivisions", [0, 1, 3])
def test_agrees_with_one_icosphere_after_the_other(subdivisions):
    mesh, owner = ball_mesh(BALLS, subdivisions=subdivisions)
    naive = ball_mesh_naive(BALLS, subdivisions)
    np.testing.assert_allclose(mesh.vertices, naive.vertices, atol=1e-12)
    np.testing.assert_array_equal(mesh.triangles, naive.faces)
    assert len(mesh.triangles) == 3 * 20 * 4**subdivisions
    assert len(mesh.vertices) == 3 * (10 * 4**subdivisions + 2)
    np.testing.assert_array_equal(np.bincount(owner), 10 * 4**subdivisions + 2)


def test_corners_lie_on_the_spheres_of_their_owners_and_volumes_approach_the_balls():
    mesh, owner = ball_mesh(BALLS, subdivisions=4)
    to_centre = np.linalg.norm(mesh.vertices - BALLS.points[owner], axis=1)
    np.testing.assert_allclose(to_centre, BALLS.radii[owner], atol=1e-12)
    volume = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).volume
    assert volume == pytest.approx(4 / 3 * np.pi * (BALLS.radii**3).sum(), rel=0.005)
    assert volume > 0  # seen counter-clockwise from outside


@pytest.mark.parametrize(
    ("balls", "triangles", "expected"),
    [(1, 10**6, 4), (1024, 500_000, 2), (100, 32_000, 2), (100, 31_999, 1), (9, 1, 1)],
)
def test_subdivisions_keep_to_the_limit_where_one_can(balls, triangles, expected):
    assert subdivisions_within(balls, triangles) == expected


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(InputError, match="no balls"):
        ball_mesh(Skeleton(np.empty((0, 3)), []), subdivisions=2)
    for subdivisions in (-1, 6):
        with pytest.raises(InputError, match=f"from 0 to 5, got {subdivisions}"):
            ball_mesh(BALLS, subdivisions=subdivisions)
