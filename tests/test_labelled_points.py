import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.sampling.choice import ARGMAX, COMPLETED, DRAWN, FIXED, Choice, write_choice
from morphoskel.sampling.labelled_points import LabelRequest, labelled_mask, read_label_sets


def naive_mask(indices, lengths, points):
    mask = np.zeros((len(indices), points), dtype=bool)
    for shape, row in enumerate(indices):
        for index in row:
            if index >= 0:
                mask[shape, index % lengths[shape]] = True
    return mask


@pytest.mark.parametrize("seed", range(5))
def test_the_mask_is_that_of_a_loop(seed):
    generator = np.random.default_rng(seed)
    indices = generator.integers(0, 30, size=(6, 9)).astype(np.int32)
    indices[[1, 4]] = -1
    lengths = generator.integers(3, 31, size=6)
    mask = labelled_mask(indices, lengths, 30)
    assert mask.dtype == np.bool_
    assert np.array_equal(mask, naive_mask(indices, lengths, 30))
    assert not mask[[1, 4]].any()
    assert not mask[np.arange(30) >= lengths[:, None]].any()  # no repeated point is marked


def test_a_repeated_point_stands_for_the_one_it_repeats():
    mask = labelled_mask(np.array([[0, 4, 5], [2, 2, 2], [-1, -1, -1]]), np.array([3, 6, 6]), 6)
    assert [np.flatnonzero(row).tolist() for row in mask] == [[0, 1, 2], [2], []]


@pytest.mark.parametrize(
    ("indices", "message"),
    [
        ([[0, 6], [0, 1]], "expected 0 to 5 for clouds of 6 points, got 0 to 6"),
        ([[0, -1], [0, 1]], "expected 0 to 5 for clouds of 6 points, got -1 to 1"),
        ([[0, 1]], "chosen of 1 shapes, but there are 2"),
    ],
)
def test_indices_of_other_clouds_are_refused(indices, message):
    with pytest.raises(InputError, match=message):
        labelled_mask(np.array(indices), np.array([6, 6]), 6)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Choices of one shape and one point, which is 100 times the training plus the draw; 50 more if completed."""
    folder = tmp_path_factory.mktemp("samples")

    def write(ratio, training, kind, draws, more=0):
        indices = (100 * training + np.arange(draws) + more).astype(np.int32)[:, None, None]
        write_choice(Choice(indices, np.ones((draws, 1), np.int32)), folder / f"{ratio}_{training}_{kind}.npz")

    write(8, 0, FIXED, 1)
    for training in (0, 2):
        write(16, training, DRAWN, 6)
        write(16, training, COMPLETED, 6, more=50)
        write(16, training, ARGMAX, 1)
    write(32, 0, DRAWN, 2)
    write(64, 0, ARGMAX, 1)
    return folder


@pytest.mark.parametrize(
    ("ratio", "number", "sets", "completed", "expected"),
    [
        (8, 0, 1, False, [0]),
        (8, 7, 3, True, [0]),  # always the same points
        (16, 0, 1, False, [0]),
        (16, 0, 2, True, [50, 51]),
        (16, 1, 2, False, [202, 203]),  # the sampler's second training has the number 2
        (16, 2, 2, False, [4, 5]),
        (16, 2, 2, True, [54, 55]),
        (16, 5, 1, False, [205]),
        (32, 1, 1, True, [1]),  # random points need not be completed
    ],
)
def test_every_training_has_draws_of_its_own(folder, ratio, number, sets, completed, expected):
    labels = read_label_sets(folder, LabelRequest(ratio, number, sets, completed))
    assert labels.shape == (len(expected), 1, 1)
    assert labels.ravel().tolist() == expected


@pytest.mark.parametrize(
    ("ratio", "number", "sets", "message"),
    [
        (4, 0, 1, "samples.*: holds no points chosen at ratio 4, only at 8, 16, 32, 64; choose"),
        (16, 3, 2, "expected at least 8 draws at ratio 16 for 2 sets of labels of training 3, got 6; draw"),
        (64, 0, 1, "holds no fixed or drawn choice at ratio 64 of training 0"),
    ],
)
def test_missing_choices_are_named(folder, ratio, number, sets, message):
    with pytest.raises(InputError, match=message):
        read_label_sets(folder, LabelRequest(ratio, number, sets, completed=False))
