import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import ball, sphere_cloud

from morphoskel.errors import InputError
from morphoskel.evaluation.compare import compare_skeleton
from morphoskel.shapes import PointCloud, Skeleton

SEEDS = st.integers(0, 2**32 - 1)


def random_skeleton(generator):
    count = generator.integers(4, 30)
    return Skeleton(generator.normal(size=(count, 3)), generator.random(count))


def naive(points, skeleton, radii):
    """Loops over points and balls: mean and largest distance, from points to balls and from balls to points."""
    to_ball, to_point = [], []
    for point in points:
        gaps = [np.linalg.norm(point - centre) for centre in skeleton.points]
        nearest = int(np.argmin(gaps))
        to_ball.append(abs(gaps[nearest] - radii[nearest]))
    for centre, radius in zip(skeleton.points, radii, strict=True):
        to_point.append(abs(min(np.linalg.norm(centre - point) for point in points) - radius))
    return (np.mean(to_ball), max(to_ball)), (np.mean(to_point), max(to_point))


def check(comparison, expected):
    np.testing.assert_allclose([comparison.other_to_skeleton, comparison.skeleton_to_other], expected, atol=1e-12)
    assert comparison.chamfer == pytest.approx(expected[0][0] + expected[1][0])
    assert comparison.hausdorff == pytest.approx(max(expected[0][1], expected[1][1]))


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_balls_with_a_cloud_agree_with_the_loops(seed):
    generator = np.random.default_rng(seed)
    skeleton, cloud = random_skeleton(generator), PointCloud(generator.normal(size=(20, 3)))
    comparison = compare_skeleton(skeleton, cloud)
    assert comparison.of_surface
    check(comparison, naive(cloud.points, skeleton, skeleton.radii))


@settings(deadline=None, max_examples=30)
@given(SEEDS)
def test_centres_with_centres_agree_with_the_loops_and_know_no_order(seed):
    generator = np.random.default_rng(seed)
    first, second = random_skeleton(generator), random_skeleton(generator)
    comparison = compare_skeleton(first, second)
    assert not comparison.of_surface
    check(comparison, naive(second.points, first, np.zeros(len(first))))
    swapped = compare_skeleton(second, first)
    assert swapped.chamfer == pytest.approx(comparison.chamfer)
    assert swapped.hausdorff == pytest.approx(comparison.hausdorff)


def test_the_ball_of_a_sphere_explains_its_cloud_and_its_mesh():
    skeleton = Skeleton([[0.0, 0, 0]], [1.0])
    assert compare_skeleton(skeleton, sphere_cloud(500)).hausdorff == pytest.approx(0, abs=1e-12)
    mesh = compare_skeleton(skeleton, ball(), samples=5000)
    assert mesh.distances.surface_points == 5000
    assert mesh.hausdorff < 1e-3  # the triangles lie a little inside the sphere


def test_points_on_a_mesh_depend_on_the_seed_alone():
    skeleton = Skeleton([[0.1, 0, 0]], [0.8])
    first, again, other = (
        compare_skeleton(skeleton, ball(subdivisions=2), samples=100, seed=seed).chamfer for seed in (1, 1, 2)
    )
    assert first == again != other


def test_a_cloud_can_stand_for_centres():
    cloud = PointCloud(np.eye(4, 3))
    skeleton = Skeleton(cloud.points, np.ones(4))
    assert compare_skeleton(skeleton, cloud, centres=True).hausdorff == 0
    assert compare_skeleton(skeleton, cloud).hausdorff == 1


def test_the_released_protocol_divides_by_the_number_of_points():
    skeleton, cloud = Skeleton([[0.0, 0, 0]], [0.5]), sphere_cloud(50)
    correct, released = (
        compare_skeleton(skeleton, cloud, protocol=protocol).skeleton_to_other[0]
        for protocol in ("correct", "released")
    )
    assert correct == pytest.approx(0.5)
    assert released == pytest.approx(0.5 / 50)


def test_what_cannot_be_compared_is_refused():
    skeleton = Skeleton([[0.0, 0, 0]], [1.0])
    with pytest.raises(InputError, match="a mesh has no centres"):
        compare_skeleton(skeleton, ball(), centres=True)
    with pytest.raises(InputError, match="samples: expected at least 4"):
        compare_skeleton(skeleton, ball(), samples=3)
    with pytest.raises(InputError, match="protocol"):
        compare_skeleton(skeleton, ball(), protocol="paper")
