import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from morphoskel.errors import InputError
from morphoskel.evaluation.sphere_metrics import (
    SphereDistances,
    cd_recon,
    hd_recon,
    mean_point_to_sphere,
    mean_sphere_to_point,
    point_to_sphere_distances,
    sphere_distances,
)

SEEDS = st.integers(0, 2**32 - 1)


def random_case(seed):
    generator = np.random.default_rng(seed)
    points, spheres = generator.integers(1, 40, size=2)
    return generator.normal(size=(points, 3)), generator.normal(size=(spheres, 3)), generator.random(spheres)


def sphere_distances_naive(surface_points, centres, radii):
    """Double loop over points and spheres."""
    to_sphere = []
    for point in surface_points:
        gaps = [float(np.linalg.norm(point - centre)) for centre in centres]
        nearest = gaps.index(min(gaps))
        to_sphere.append(abs(gaps[nearest] - radii[nearest]))
    to_point = [
        abs(min(float(np.linalg.norm(centre - point)) for point in surface_points) - radius)
        for centre, radius in zip(centres, radii, strict=True)
    ]
    return SphereDistances(
        len(surface_points), len(centres), sum(to_sphere), max(to_sphere), sum(to_point), max(to_point)
    )


def numbers(distances):
    return np.array([*vars(distances).values()], dtype=float)


@settings(deadline=None)
@given(SEEDS)
def test_agrees_with_the_double_loop(seed):
    case = random_case(seed)
    np.testing.assert_allclose(numbers(sphere_distances(*case)), numbers(sphere_distances_naive(*case)), atol=1e-12)


def unit_sphere(count):
    points = np.random.default_rng(1).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


@pytest.mark.parametrize("protocol", ["correct", "released"])
def test_the_sphere_itself_has_distance_zero(protocol):
    distances = sphere_distances(unit_sphere(100), np.zeros((1, 3)), np.ones(1))
    assert cd_recon(distances, protocol) == pytest.approx(0, abs=1e-12)
    assert hd_recon(distances) == pytest.approx(0, abs=1e-12)


def test_a_sphere_of_half_the_radius_is_half_off_both_ways():
    distances = sphere_distances(unit_sphere(100), np.zeros((1, 3)), np.full(1, 0.5))
    assert mean_point_to_sphere(distances) == pytest.approx(0.5)
    assert mean_sphere_to_point(distances, "correct") == pytest.approx(0.5)
    assert cd_recon(distances, "correct") == pytest.approx(1)
    assert hd_recon(distances) == pytest.approx(0.5)


def test_by_hand_with_the_nearest_centre_instead_of_the_nearest_sphere():
    """The point at 4 is nearer to the large sphere's surface, but belongs to the small sphere at 6."""
    surface = np.array([[4.0, 0, 0], [8.0, 0, 0]])
    centres, radii = np.array([[0.0, 0, 0], [6.0, 0, 0], [9.0, 0, 0]]), np.array([3.5, 0.25, 1.0])
    distances = sphere_distances(surface, centres, radii)
    # points: |2 - 0.25|, |1 - 1|; spheres: |4 - 3.5|, |2 - 0.25|, |1 - 1|
    assert distances == SphereDistances(2, 3, 1.75, 1.75, 2.25, 1.75)
    assert cd_recon(distances, "correct") == 1.75 / 2 + 2.25 / 3
    assert cd_recon(distances, "released") == 1.75 / 2 + 2.25 / 2
    assert hd_recon(distances) == 1.75


@settings(deadline=None)
@given(SEEDS)
def test_each_point_alone_is_as_far_from_its_sphere_as_among_others(seed):
    points, centres, radii = random_case(seed)
    distances = point_to_sphere_distances(points, centres, radii)
    alone = [sphere_distances(point[None], centres, radii).point_to_sphere_max for point in points]
    np.testing.assert_allclose(distances, alone, atol=1e-12)


def test_hausdorff_takes_the_larger_direction():
    assert hd_recon(SphereDistances(1, 1, 0, 0.25, 0, 0.5)) == 0.5
    assert hd_recon(SphereDistances(1, 1, 0, 0.5, 0, 0.25)) == 0.5


def test_the_released_second_term_is_smaller_by_spheres_over_points():
    """1024 spheres and 2000 points, as in the paper, make 0.512."""
    distances = SphereDistances(2000, 1024, 3.0, 1.0, 7.0, 1.0)
    ratio = mean_sphere_to_point(distances, "released") / mean_sphere_to_point(distances, "correct")
    assert ratio == pytest.approx(0.512)
    assert cd_recon(distances, "released") == pytest.approx(3 / 2000 + 7 / 2000)
    assert cd_recon(distances, "correct") == pytest.approx(3 / 2000 + 7 / 1024)


@settings(deadline=None)
@given(SEEDS)
def test_rigid_motions_change_nothing(seed):
    surface, centres, radii = random_case(seed)
    generator = np.random.default_rng(seed + 1)
    rotation, shift = Rotation.random(rng=generator), generator.normal(size=3)
    moved = sphere_distances(rotation.apply(surface) + shift, rotation.apply(centres) + shift, radii)
    np.testing.assert_allclose(numbers(moved), numbers(sphere_distances(surface, centres, radii)), atol=1e-10)


@settings(deadline=None)
@given(SEEDS, st.floats(1e-3, 1e3))
def test_distances_scale_with_the_shape(seed, scale):
    surface, centres, radii = random_case(seed)
    before = sphere_distances(surface, centres, radii)
    after = sphere_distances(scale * surface, scale * centres, scale * radii)
    for protocol in ("correct", "released"):
        assert cd_recon(after, protocol) == pytest.approx(scale * cd_recon(before, protocol), rel=1e-9)
    assert hd_recon(after) == pytest.approx(scale * hd_recon(before), rel=1e-9)


@settings(deadline=None)
@given(SEEDS)
def test_chamfer_is_at_most_twice_hausdorff(seed):
    distances = sphere_distances(*random_case(seed))
    assert cd_recon(distances, "correct") <= 2 * hd_recon(distances) + 1e-12


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ((np.zeros((0, 3)), np.zeros((1, 3)), np.ones(1)), r"surface_points: expected shape \(N, 3\) with N >= 1"),
        ((np.zeros((1, 3)), np.zeros((0, 3)), np.ones(0)), r"centres: expected shape \(N, 3\) with N >= 1"),
        ((np.zeros((1, 2)), np.zeros((1, 3)), np.ones(1)), r"surface_points: .* got \(1, 2\)"),
        ((np.zeros((1, 3)), np.zeros((2, 3)), np.ones(1)), r"radii: expected shape \(2,\), one a centre, got \(1,\)"),
        ((np.zeros((1, 3)), np.zeros((1, 3)), -np.ones(1)), "radii: every value must be finite and at least 0"),
        ((np.zeros((1, 3)), np.zeros((1, 3)), np.array([np.nan])), "radii: every value must be finite"),
        ((np.array([[0, 0, 0], [0, np.inf, 0]]), np.zeros((1, 3)), np.ones(1)), "1 of 2 rows .* the first is row 1"),
    ],
)
def test_illegal_arrays_are_named(arrays, message):
    with pytest.raises(InputError, match=message):
        sphere_distances(*arrays)


def test_an_unknown_protocol_is_refused():
    with pytest.raises(InputError, match="protocol"):
        cd_recon(SphereDistances(1, 1, 0, 0, 0, 0), "paper")
