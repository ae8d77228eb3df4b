import numpy as np
import pytest
from illustrated import SEED, illustrated
from scipy.spatial import KDTree
from solids import ball, sphere_cloud

from morphoskel.errors import ShapeError
from morphoskel.reporting.illustrate import Limits, illustrate, residue_edges
from morphoskel.reporting.illustrated_shapes import named_shape
from morphoskel.shapes import Mesh
from morphoskel.skeletonization import skeletonize_shape
from morphoskel.volume import Candidates

CANDIDATES = {"mode": "random", "count": 4000}


def run(shape, **changes):
    settings = {"name": "ball", "candidates": CANDIDATES, "k": 20, "points": 30, "seed": SEED, "threads": 1}
    return illustrate(shape, **(settings | changes))


@pytest.fixture(scope="module")
def whole():
    """A closed ball of which nothing is left out."""
    return run(ball(subdivisions=4), is_closed=True)


@pytest.mark.parametrize("shape", [ball(subdivisions=3), sphere_cloud(500)], ids=["mesh", "cloud"])
def test_the_points_selected_are_the_skeleton_of_the_library(shape):
    coarse = {"watertight_settings": {"resolution": 1000}, "reconstruction": {"depth": 4}}
    settings = {"candidates": CANDIDATES, "k": 20, "points": 30, "seed": SEED, "name": "ball", "threads": 1}
    expected = skeletonize_shape(shape, **settings, **coarse)
    illustration = run(shape, **coarse)
    skeleton = illustration.skeleton
    assert np.array_equal(skeleton.points, expected.skeleton.points)
    assert np.array_equal(skeleton.radii, expected.skeleton.radii)
    assert np.array_equal(skeleton.residues, expected.skeleton.residues)
    assert np.array_equal(illustration.surface.vertices, expected.surface.vertices)


def test_every_stage_is_what_its_definition_says(whole):
    distances = np.linalg.norm(whole.candidates, axis=1)
    clear = np.abs(distances - 1) > 0.01  # the ball has facets
    assert np.array_equal(whole.inside[clear], distances[clear] < 1)
    assert len(whole.inner) == whole.inner_count == whole.inside.sum()
    assert np.allclose(whole.udf, 1 - np.linalg.norm(whole.inner, axis=1), atol=0.01)
    nearest = KDTree(whole.inner).query(whole.inner, 20)[1]
    assert (whole.dilated == whole.udf[nearest].max(axis=1)).mean() > 0.999  # but for ties in distance
    assert set(whole.selected) == set(np.argsort(whole.residues, kind="stable")[:30])
    assert np.array_equal(whole.residue_counts, np.histogram(whole.residues, whole.residue_edges)[0])


def test_a_mesh_said_to_be_closed_stays_as_it_is_and_an_open_one_is_refused(whole):
    assert np.array_equal(whole.surface.vertices, ball(subdivisions=4).vertices)
    with pytest.raises(ShapeError, match="not closed"):
        run(Mesh(ball().vertices, ball().triangles[1:]), is_closed=True)


def test_what_is_kept_is_bounded_but_holds_all_points_selected(whole):
    part = run(ball(subdivisions=4), is_closed=True, limits=Limits(cloud=100, candidates=200, inner=300))
    assert (len(part.cloud), len(part.candidates)) == (100, 200)
    assert 300 <= len(part.inner) <= 330
    assert part.inner_count == whole.inner_count
    assert np.array_equal(part.residue_counts, whole.residue_counts)
    assert np.array_equal(part.skeleton.points, whole.skeleton.points)
    where = {tuple(point): row for row, point in enumerate(whole.inner)}
    rows = [where[tuple(point)] for point in part.inner]
    assert np.array_equal(part.udf, whole.udf[rows])
    assert np.array_equal(part.dilated, whole.dilated[rows])


def test_the_candidates_kept_are_some_of_those_tested(monkeypatch):
    monkeypatch.setattr("morphoskel.volume.candidates.CHUNK_TILES", 5)  # many chunks
    part = run(ball(subdivisions=2), is_closed=True, limits=Limits(candidates=150))
    everything = np.concatenate(list(Candidates(*part.surface.bounds, **CANDIDATES, seed=1).chunks()))
    whole = run(ball(subdivisions=2), is_closed=True, limits=Limits(candidates=len(everything)))
    inside = {tuple(point): flag for point, flag in zip(whole.candidates, whole.inside, strict=True)}
    assert len(inside) == part.candidate_count == 4000
    assert [inside[tuple(point)] for point in part.candidates] == part.inside.tolist()


def test_a_grid_is_counted_by_its_nodes():
    assert illustrated("box", "grid", 3000).candidate_count == 14**3


def test_threads_do_not_matter_and_the_seed_does(whole):
    assert np.array_equal(run(ball(subdivisions=4), is_closed=True, threads=2).inner, whole.inner)
    assert not np.array_equal(run(ball(subdivisions=4), is_closed=True, seed=SEED + 1).candidates, whole.candidates)


def test_bins_of_residues_are_equal_in_logarithm_from_the_longest_side_down():
    edges = residue_edges(named_shape("torus"))
    assert edges[0] == 0
    assert edges[-1] == pytest.approx(2.0, abs=1e-6)
    assert np.allclose(np.diff(np.log10(edges[1:])), 1 / 6)
