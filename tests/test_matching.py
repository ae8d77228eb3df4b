import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.sampling.matching import complete, match, match_and_complete, match_clouds
from morphoskel.skeleton.thinning import farthest_points

NONE = np.array([], dtype=np.int64)


@pytest.fixture
def generator():
    return np.random.default_rng(0)


def match_naively(points, generated):
    found = []
    for query in generated:
        distances = [sum((query - point) ** 2) for point in points]
        nearest = distances.index(min(distances))
        if nearest not in found:
            found.append(nearest)
    return found


def complete_naively(points, chosen, count):
    result = list(chosen)
    while len(result) < count:
        best, gap = None, -1.0
        for index, point in enumerate(points):
            distance = min((sum((point - points[other]) ** 2) for other in result), default=np.inf)
            if index not in result and distance > gap:
                best, gap = index, distance
        result.append(best)
    return result


@pytest.mark.parametrize("generated_points", [1, 5, 40])
def test_matching_agrees_with_its_definition(generator, generated_points):
    points, generated = generator.normal(size=(60, 3)), generator.normal(size=(generated_points, 3))
    matched = match(points, generated)
    assert matched.tolist() == match_naively(points, generated)
    indices, number = match_and_complete(points, generated)
    assert number == len(matched)
    assert indices.tolist() == complete_naively(points, matched, generated_points)
    assert indices.dtype == np.int64


def test_points_on_a_grid_tie_as_defined(generator):
    points = generator.integers(0, 3, size=(30, 3)).astype(np.float32)
    generated = generator.integers(0, 5, size=(20, 3)).astype(np.float32) / 2
    matched = match(points, generated)
    assert matched.tolist() == match_naively(points, generated)
    assert complete(points, matched, 30).tolist() == complete_naively(points, matched, 30)


def test_generated_points_of_the_cloud_are_kept_as_they_are(generator):
    points = generator.normal(size=(50, 3))
    wanted = generator.permutation(50)[:20]
    indices, matched = match_and_complete(points, points[wanted])
    assert indices.tolist() == wanted.tolist()
    assert matched == 20


def test_exactly_as_many_distinct_points_as_generated_even_if_all_fall_together(generator):
    points = generator.normal(size=(50, 3))
    for count in (1, 7, 50):
        indices, matched = match_and_complete(points, np.zeros((count, 3)))
        assert len(np.unique(indices)) == len(indices) == count
        assert matched == 1


def test_coinciding_input_points_are_still_chosen_once_each():
    points = np.zeros((6, 3))
    points[3] = 1
    indices, matched = match_and_complete(points, np.zeros((6, 3)))
    assert indices.tolist() == [0, 3, 1, 2, 4, 5]
    assert matched == 1


def test_a_larger_completion_extends_a_smaller_one(generator):
    points, chosen = generator.normal(size=(40, 3)), np.array([7, 3, 30])
    whole = complete(points, chosen, 40)
    assert sorted(whole) == list(range(40))
    for count in (3, 4, 21):
        assert complete(points, chosen, count).tolist() == whole[:count].tolist()


def test_completing_nothing_is_farthest_point_sampling_from_the_first_point(generator):
    points = generator.normal(size=(40, 3))
    assert complete(points, NONE, 25).tolist() == farthest_points(points, 25).tolist()


def test_clouds_are_matched_one_by_one(generator):
    points, generated = generator.normal(size=(4, 30, 3)), generator.normal(size=(4, 12, 3))
    indices, matched = match_clouds(points, generated)
    assert indices.shape == (4, 12)
    for row in range(4):
        alone = match_and_complete(points[row], generated[row])
        assert indices[row].tolist() == alone.indices.tolist()
        assert matched[row] == alone.matched


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: match(np.zeros((3, 2)), np.zeros((1, 3))), "points: expected shape"),
        (lambda: match(np.zeros((3, 3)), np.zeros((0, 3))), "generated: expected shape"),
        (lambda: match(np.zeros((3, 3)), np.full((1, 3), np.nan)), "generated: every coordinate must be finite"),
        (lambda: match_and_complete(np.zeros((3, 3)), np.zeros((4, 3))), "count: expected 1 to 3"),
        (lambda: complete(np.zeros((3, 3)), np.array([1, 1]), 3), "chosen: expected distinct"),
        (lambda: complete(np.zeros((3, 3)), np.array([0.0]), 3), "chosen: expected distinct integers"),
        (lambda: complete(np.zeros((3, 3)), np.array([-1]), 3), "chosen: expected indices from 0 to 2"),
        (lambda: complete(np.zeros((3, 3)), np.array([3]), 3), "chosen: expected indices from 0 to 2"),
        (lambda: complete(np.zeros((3, 3)), np.array([0, 1]), 1), "count: expected 2 to 3"),
        (lambda: complete(np.zeros((3, 3)), NONE, 0), "count: expected 1 to 3"),
        (lambda: match_clouds(np.zeros((2, 3, 3)), np.zeros((1, 3, 3))), "got 2 clouds and 1 sets"),
        (lambda: match_clouds(np.zeros((0, 3, 3)), np.zeros((0, 3, 3))), "at least one cloud"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()
