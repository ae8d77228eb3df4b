import pytest

from morphoskel.cores import available_cores, split_cores


@pytest.mark.parametrize(
    ("cores", "threads", "shapes", "expected"),
    [
        (2, 1, 64, (2, 1)),
        (2, 2, 64, (1, 2)),
        (8, 3, 64, (2, 4)),
        (8, 1, 3, (3, 2)),
        (2, 1, 1, (1, 2)),
        (2, 16, 5, (1, 2)),
        (2, 1, 0, (1, 2)),
    ],
)
def test_cores_are_split_between_shapes_and_threads(cores, threads, shapes, expected):
    assert split_cores(cores, threads, shapes) == expected


def test_no_more_threads_than_cores():
    for cores in range(1, 20):
        for threads in range(1, 20):
            for shapes in range(20):
                workers, each = split_cores(cores, threads, shapes)
                assert 1 <= workers * each <= cores


def test_some_core_is_available():
    assert available_cores() >= 1
