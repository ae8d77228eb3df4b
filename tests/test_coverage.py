import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from solids import ball, box, joined, sphere_cloud

from morphoskel.errors import InputError, ShapeError
from morphoskel.formats.sample import sample_surface
from morphoskel.morphology import dilation, residue
from morphoskel.shapes import Mesh
from morphoskel.skeleton import coverage
from morphoskel.skeleton.coverage import choose_covering, coverage_skeleton, nominate, typical_radius
from morphoskel.skeleton.selection import skeleton_of
from morphoskel.surface.repair import mean_spacing
from morphoskel.volume import Candidates, SurfaceDistance, occupancy


def distances(points, centre):
    x, y, z = (points - centre).T
    return np.sqrt(x**2 + y**2 + z**2)


def choose_covering_naive(surface_points, centres, radii, count, tolerance):
    """Keep the table of all distances, and the chosen balls as a list; all else follows from them each time."""
    gaps = np.array([distances(surface_points, centre) for centre in centres])
    apart = np.array([distances(centres, centre) for centre in centres])
    own_errors = np.abs(gaps - radii[:, None])
    chosen, given_up = [int(np.argmax(radii))], set()
    while len(chosen) < min(count, len(centres)):
        nearest = np.array(chosen)[gaps[chosen].argmin(axis=0)]
        points = np.arange(len(surface_points))
        to_centre, error = gaps[nearest, points], own_errors[nearest, points]
        free = [ball for ball in range(len(centres)) if ball not in chosen]
        ball = None
        for worst in sorted(points, key=lambda point: -error[point]):
            if worst in given_up or error[worst] == 0:
                continue
            better = [b for b in free if gaps[b, worst] < to_centre[worst] and own_errors[b, worst] < error[worst]]
            contenders = sorted(better, key=lambda b: own_errors[b, worst])[: coverage.CONTENDERS]
            gains = [
                sum((error[p] ** 2 - own_errors[b, p] ** 2 for p in points if gaps[b, p] < to_centre[p]), 0.0)
                for b in contenders
            ]
            if contenders and (max(gains) > 0 or error[worst] > tolerance):
                ball = contenders[int(np.argmax(gains))]
                break
            given_up.add(worst)
        if ball is None:
            ball = max(free, key=lambda b: apart[b, chosen].min())
        given_up -= {p for p in points if gaps[ball, p] < to_centre[p]}
        chosen.append(ball)
    return chosen


@settings(max_examples=80, deadline=None)
@given(
    st.integers(0, 10_000),
    st.integers(1, 50),
    st.sampled_from([0.0, 0.05, 0.4]),
    st.sampled_from([2, 20]),
    st.booleans(),
)
def test_the_choice_equals_its_naive_twin(seed, count, tolerance, contenders, on_a_grid):
    generator = np.random.default_rng(seed)
    surface, centres = generator.normal(size=(30, 3)), generator.normal(size=(40, 3)) * 0.7
    if on_a_grid:  # many ties of distances and errors, some of the points the same
        surface, centres = np.rint(3 * surface), np.rint(4 * centres)
    radii = cdist(centres, surface).min(axis=1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coverage, "CONTENDERS", contenders)
        chosen = choose_covering(surface, centres, radii, count, tolerance=tolerance)
        assert chosen.tolist() == choose_covering_naive(surface, centres, radii, count, tolerance)
    assert len(np.unique(chosen)) == len(chosen) == min(count, 40)


def test_worst_point_first_and_then_the_most_helpful_ball():
    """On a line, by hand: the ball at 0 explains 1 and not 10; both others explain 10, but one also explains 8."""
    surface = np.array([[1.0, 0, 0], [8, 0, 0], [10, 0, 0]])
    centres, radii = np.array([[0.0, 0, 0], [10.5, 0, 0], [9.0, 0, 0]]), np.array([1.1, 0.5, 1.0])
    assert choose_covering(surface, centres, radii, 3, tolerance=0.0).tolist() == [0, 2, 1]


def nominate_naive(nearest, residues, udf, nominees, largest_residue):
    nominated = []
    for point in sorted(set(nearest)):
        own = [c for c in range(len(nearest)) if nearest[c] == point]
        own.sort(key=lambda c: (residues[c], -udf[c], c))
        small = [c for c in own if residues[c] <= largest_residue]
        nominated += small[:nominees] if small else own[: coverage.NOMINEES_OF_A_THIN_PART]
    return nominated


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 5), st.sampled_from([-1.0, 0.0, 0.3, 2.0]))
def test_the_nominees_equal_their_naive_twin(seed, nominees, largest_residue):
    generator = np.random.default_rng(seed)
    nearest = generator.integers(0, 12, 80)
    residues, udf = (generator.integers(0, 8, 80).astype(np.float32) / 8 for _ in range(2))
    found = nominate(nearest, residues, udf, nominees, largest_residue)
    assert found.tolist() == nominate_naive(nearest, residues, udf, nominees, largest_residue)
    assert set(nearest[found]) == set(nearest)  # every point has its say


def test_the_typical_radius_is_that_of_a_ball_with_k_candidates():
    """Count candidates around places so far inside the box that the ball does not leave it."""
    candidates = Candidates(np.array([0.0, -1, 2]), np.array([2.0, 0, 3]), 20_000, seed=3)
    radius = typical_radius(candidates, 50)
    points = np.vstack(list(candidates.chunks()))
    places = np.random.default_rng(0).uniform(candidates.lower + radius, candidates.upper - radius, (300, 3))
    counts = (cdist(places, points) < radius).sum(axis=1)
    assert counts.mean() == pytest.approx(50, rel=0.03)


class Shape:
    """A solid, its cloud, and what the chain computes of it before balls are selected."""

    def __init__(self, solid, cloud, candidates=30_000, k=20):
        self.cloud = cloud
        scattered = Candidates(*solid.bounds, candidates, seed=1)
        self.inner = occupancy(solid, scattered).inner_points()
        self.udf = SurfaceDistance(solid)(self.inner)
        self.dilated = dilation(self.inner, self.udf, k)
        self.element_radius = typical_radius(scattered, k)

    def cover(self, points, **changes):
        arguments = {"inner": self.inner, "udf": self.udf, "surface_points": self.cloud, "points": points,
                     "residues": residue(self.udf, self.dilated), "element_radius": self.element_radius}  # fmt: skip
        return coverage_skeleton(**{**arguments, **changes})


def moved(mesh, *shift):
    return Mesh(mesh.vertices + np.array(shift), mesh.triangles)


def sampled(mesh, count=1500):
    return sample_surface(mesh, count, np.random.default_rng(2)).points


BOX, ROD = box(1, 1, 1), moved(box(1, 0.1, 0.1), 1.02, 0.3, -0.2)


@pytest.fixture(scope="module")
def box_and_rod():
    return Shape(joined([BOX, ROD]), sampled(joined([BOX, ROD])))


def errors_of(skeleton, surface_points):
    gaps = cdist(surface_points, skeleton.points)
    nearest = gaps.argmin(axis=1)
    return np.abs(gaps.min(axis=1) - skeleton.radii[nearest])


@pytest.mark.parametrize("points", [30, 100])
def test_explains_the_surface_better_than_the_smallest_residues(box_and_rod, points):
    covering = box_and_rod.cover(points)
    smallest = skeleton_of(box_and_rod.inner, box_and_rod.udf, box_and_rod.dilated, points)
    assert len(covering) == len(smallest) == points
    surface = sampled(joined([BOX, ROD]), 3000) if points == 30 else box_and_rod.cloud
    assert errors_of(covering, surface).max() < 0.8 * errors_of(smallest, surface).max()
    assert errors_of(covering, surface).mean() < 0.8 * errors_of(smallest, surface).mean()


def test_more_balls_explain_the_surface_better(box_and_rod):
    largest = [errors_of(box_and_rod.cover(points), box_and_rod.cloud).max() for points in (5, 25, 125)]
    assert largest == sorted(largest, reverse=True)
    assert largest[-1] < largest[0] / 4


def test_every_part_gets_balls(box_and_rod):
    rod = box_and_rod.cloud[:, 0] > 0.51
    skeleton = box_and_rod.cover(30)
    assert 0 < (skeleton.points[:, 0] > 0.51).sum() < 15
    assert errors_of(skeleton, box_and_rod.cloud[rod]).max() < 0.3


def test_the_first_balls_are_the_skeleton_of_fewer(box_and_rod):
    many = box_and_rod.cover(90)
    few = box_and_rod.cover(30, threads=2)
    np.testing.assert_array_equal(few.points, many.points[:30])
    np.testing.assert_array_equal(few.radii, many.radii[:30])
    np.testing.assert_array_equal(few.residues, many.residues[:30])
    assert many.radii[0] == pytest.approx(0.5, abs=0.05)  # the largest comes first


@pytest.mark.parametrize("touch", [0.25, 1.0])
def test_all_balls_touch_the_cloud(box_and_rod, touch):
    skeleton = box_and_rod.cover(100, touch=touch)
    index = [np.flatnonzero((box_and_rod.inner == point).all(axis=1))[0] for point in skeleton.points]
    to_cloud = cdist(skeleton.points, box_and_rod.cloud).min(axis=1)
    np.testing.assert_allclose(skeleton.radii, to_cloud, rtol=1e-12)
    gaps = np.abs(to_cloud - box_and_rod.udf[index])
    assert gaps.max() <= touch * mean_spacing(box_and_rod.cloud)
    np.testing.assert_array_equal(skeleton.residues, (box_and_rod.dilated - box_and_rod.udf)[index])


def test_an_invented_part_gets_no_ball():
    """The cloud knows only of the first box. Beyond it, all balls are too small to reach back to its points."""
    invented = Shape(joined([BOX, moved(BOX, 1.4, 0, 0)]), sampled(BOX))
    assert (invented.inner[:, 0] > 0.6).mean() > 0.4
    skeleton = invented.cover(200)
    assert len(skeleton) == 200
    assert skeleton.points[:, 0].max() < 0.5
    real = Shape(joined([BOX, moved(BOX, 1.4, 0, 0)]), sampled(joined([BOX, moved(BOX, 1.4, 0, 0)])))
    assert (real.cover(200).points[:, 0] > 0.6).mean() > 0.3


def test_moves_and_scales_with_the_shape():
    """Exact, since on a fine lattice of dyadic numbers no rounding interferes."""
    generator = np.random.default_rng(5)
    surface = np.rint(sphere_cloud(300).points * 1024) / 1024
    inner = (np.rint(generator.uniform(-0.5, 0.5, (2000, 3)) * 1024) / 1024).astype(np.float32)
    udf = cdist(inner, surface).min(axis=1).astype(np.float32)
    residues = dilation(inner, udf, 10) - udf
    plain = coverage_skeleton(inner, udf, residues, surface, points=60, element_radius=0.125)
    for factor, shift in ((4.0, 0.0), (0.125, 0.0), (1.0, 2.0), (2.0, -3.0)):
        skeleton = coverage_skeleton(
            (factor * inner + shift).astype(np.float32),
            factor * udf,
            factor * residues,
            factor * surface + shift,
            points=60,
            element_radius=factor * 0.125,
        )
        np.testing.assert_array_equal(skeleton.points, factor * plain.points + shift)
        np.testing.assert_array_equal(skeleton.radii, factor * plain.radii)


def test_one_ball_is_found_in_a_ball():
    shape = Shape(ball(), sphere_cloud(2000).points)
    skeleton = shape.cover(1)
    assert np.linalg.norm(skeleton.points[0]) < 0.1
    assert skeleton.radii[0] == pytest.approx(1, abs=0.1)


def test_of_a_large_cloud_every_so_manieth_point_takes_part(box_and_rod, monkeypatch):
    monkeypatch.setattr(coverage, "MOST_SURFACE_POINTS", 600)
    thinned = box_and_rod.cover(40)
    monkeypatch.undo()
    np.testing.assert_array_equal(thinned.points, box_and_rod.cover(40, surface_points=box_and_rod.cloud[::3]).points)
    assert not np.array_equal(thinned.points, box_and_rod.cover(40).points)


def test_what_cannot_be_covered_is_said(box_and_rod):
    with pytest.raises(ShapeError, match=r"none of [0-9]+ inner points is as far from the cloud.*coverage\.touch"):
        box_and_rod.cover(10, surface_points=box_and_rod.cloud + 5)
    for surface in (box_and_rod.cloud[:1], np.ones((4, 3)), np.empty((0, 3))):
        with pytest.raises(InputError, match="at least 2 distinct surface points"):
            box_and_rod.cover(10, surface_points=surface)
