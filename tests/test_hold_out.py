import pytest

from morphoskel.errors import InputError
from morphoskel.learning.hold_out import hold_out


def test_a_share_of_each_category_is_held_out():
    categories = [*"a" * 10, *"b" * 5, "c"]
    training, validation = hold_out(categories, 0.2, seed=1)
    assert [[categories[at] for at in validation].count(name) for name in "abc"] == [2, 1, 0]
    assert sorted([*training, *validation]) == list(range(16))


def test_what_is_held_out_depends_on_the_seed_alone():
    first, again, other = (hold_out(["a"] * 20, 0.2, seed)[1].tolist() for seed in (1, 1, 2))
    assert first == again != other


def test_something_is_always_held_out():
    training, validation = hold_out(["a", "b"], 0.2, seed=1)
    assert (len(training), len(validation)) == (1, 1)
    with pytest.raises(InputError, match="at least 2 are needed"):
        hold_out(["a"], 0.2, seed=1)
