import pytest

from morphoskel.durations import describe_roughly, describe_seconds


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0, "0.0 s"),
        (0.42, "0.4 s"),
        (0.97, "1 s"),
        (14.2, "14 s"),
        (59.6, "1 min 00 s"),
        (192, "3 min 12 s"),
        (3599.7, "1 h 00 min"),
        (7500, "2 h 05 min"),
        (7199, "2 h 00 min"),
    ],
)
def test_durations_have_two_units_at_most(seconds, words):
    assert describe_seconds(seconds) == words


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (3, "less than 10 s"),
        (38, "about 40 s"),
        (57, "about 1 min"),
        (840, "about 14 min"),
        (3600, "about 1 h 00 min"),
        (9000, "about 2 h 30 min"),
        (7180, "about 2 h 00 min"),
        (50 * 3600, "about 50 h"),
    ],
)
def test_estimates_are_rounded(seconds, words):
    assert describe_roughly(seconds) == words
