import numpy as np
import pytest
from scipy import stats

from morphoskel.errors import InputError
from morphoskel.volume import Candidates
from morphoskel.volume.candidates import CHUNK_TILES, TILE_POINTS

LOWER, UPPER = np.array([-1.0, 2.0, 0.0]), np.array([3.0, 2.5, 1.0])


def all_points(**settings):
    return np.concatenate(list(Candidates(LOWER, UPPER, **settings).chunks()))


@pytest.mark.parametrize("count", [8, 1000, 20_000, 600_001])
def test_random_mode_gives_exactly_the_count_inside_the_box(count):
    points = all_points(count=count, seed=5)
    assert points.shape == (count, 3)
    assert points.dtype == np.float32
    assert (points >= LOWER - 1e-6).all()
    assert (points <= UPPER + 1e-6).all()


@pytest.mark.parametrize("seed", [0, 5, 2**63 - 1])
def test_random_mode_equals_its_naive_twin(seed):
    """NumPy's own generators, one a tile."""
    candidates = Candidates(LOWER, UPPER, 20_000, seed=seed)
    size = (UPPER - LOWER) / candidates.tiles_per_axis
    streams = (np.random.Generator(np.random.Philox(key=[seed, tile + 1])) for tile in range(len(candidates.cells)))
    tiles = zip(candidates.cells, candidates.counts, streams, strict=True)
    naive = [(LOWER + (cell + stream.random((count, 3))) * size).astype(np.float32) for cell, count, stream in tiles]
    assert np.array_equal(np.concatenate(list(candidates.chunks())), np.concatenate(naive))


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_points_of_a_tile_do_not_depend_on_the_others(mode):
    candidates = Candidates(LOWER, UPPER, 20_000, mode, seed=7)
    everything, offsets = np.concatenate(list(candidates.chunks())), np.cumsum([0, *candidates.counts])
    for tile in (0, 3, len(candidates.cells) - 1):
        assert np.array_equal(candidates.points(np.array([tile])), everything[offsets[tile] : offsets[tile + 1]])


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_points_lie_in_their_tiles(mode):
    candidates = Candidates(LOWER, UPPER, 20_000, mode, seed=7)
    tile = np.repeat(np.arange(len(candidates.cells)), candidates.counts)
    points = np.concatenate(list(candidates.chunks()))
    for axis in range(3):
        cell = candidates.cells[tile, axis]
        assert (points[:, axis] >= candidates.edges[axis, cell] - 1e-6).all()
        assert (points[:, axis] <= candidates.edges[axis, cell + 1] + 1e-6).all()


@pytest.mark.parametrize("per_axis", [1, 2, 5, 8])
def test_tiles_follow_a_morton_curve(per_axis):
    def code(cell):
        return sum(((int(cell[axis]) >> bit) & 1) << (3 * bit + axis) for bit in range(8) for axis in range(3))

    candidates = Candidates(LOWER, UPPER, (4 * per_axis) ** 3, "grid")
    cells = sorted(np.ndindex(per_axis, per_axis, per_axis), key=code)
    assert candidates.cells.tolist() == [list(cell) for cell in cells]


def test_random_mode_is_uniform():
    """Kolmogorov-Smirnov along each axis, and a chi-square test of the joint counts in boxes that straddle tiles."""
    points = (all_points(count=200_000, seed=11) - LOWER) / (UPPER - LOWER)
    for axis in range(3):
        assert stats.kstest(points[:, axis], "uniform").pvalue > 1e-3
    counts, _ = np.histogramdd(points, bins=7, range=[(0, 1)] * 3)
    assert stats.chisquare(counts.ravel()).pvalue > 1e-3


def test_counts_of_boxes_vary_like_those_of_independent_points():
    """A stratified draw would have too regular counts: their variance must be that of the binomial law."""
    counts = [(all_points(count=4000, seed=seed)[:, 0] < LOWER[0] + 1.2).sum() for seed in range(200)]
    expected = 4000 * 0.3 * 0.7
    assert 0.7 * expected < np.var(counts) < 1.4 * expected


def test_random_mode_depends_on_the_seed_only():
    assert np.array_equal(all_points(count=5000, seed=1), all_points(count=5000, seed=1))
    assert not np.array_equal(all_points(count=5000, seed=1), all_points(count=5000, seed=2))


@pytest.mark.parametrize(("count", "per_axis"), [(8, 2), (1000, 10), (1_000_000, 100), (10_000_000, 215), (999, 9)])
def test_grid_mode_has_the_released_number_of_nodes(count, per_axis):
    candidates = Candidates(LOWER, UPPER, count, "grid")
    assert candidates.nodes_per_axis == per_axis
    assert len(candidates) == per_axis**3


def test_grid_mode_is_the_full_grid_from_corner_to_corner():
    points = all_points(count=23**3, mode="grid")
    axes = [np.linspace(low, high, 23) for low, high in zip(LOWER, UPPER, strict=True)]
    naive = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3).astype(np.float32)
    assert np.array_equal(np.unique(points, axis=0), np.unique(naive, axis=0))


@pytest.mark.parametrize("mode", ["random", "grid"])
def test_neighbours_in_memory_are_neighbours_in_space(mode):
    points = all_points(count=64_000, mode=mode, seed=3) / (UPPER - LOWER)
    shuffled = np.random.default_rng(0).permutation(points)
    step, random_step = (np.linalg.norm(np.diff(order, axis=0), axis=1).mean() for order in (points, shuffled))
    assert step < random_step / 3


def test_chunks_bound_memory():
    sizes = [len(chunk) for chunk in Candidates(LOWER, UPPER, 1_000_000, seed=1).chunks()]
    assert sum(sizes) == 1_000_000
    assert max(sizes) < CHUNK_TILES * TILE_POINTS * 1.2


@pytest.mark.parametrize("upper", [[3.0, 2.0, 1.0], [-2.0, 2.5, 1.0]])
def test_an_empty_box_is_refused(upper):
    with pytest.raises(InputError, match="no volume"):
        Candidates(LOWER, np.array(upper), 100)
