import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.scene import Layer, Scalar, Scene

PLACES = np.eye(3)


def layer(**changes):
    return Layer(**{"name": "a", "kind": "points", "positions": PLACES, **changes})


@pytest.mark.parametrize(
    ("values", "limits"), [([0.5, 2], (0, 2)), ([-1, 2], (-1, 2)), ([-2, -1], (-2, 0)), ([0, 0], (0, 0)), ([], (0, 0))]
)
def test_colours_begin_at_zero_or_below(values, limits):
    assert Scalar("height", values).limits == limits


def test_limits_can_be_given():
    assert Scalar("height", [0.0, 9.0], (1, 2)).limits == (1, 2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.eye(2),), r"height: expected finite values of shape \(N,\), got shape \(2, 2\)"),
        (([np.nan],), "height: expected finite values"),
        (([1.0], (2, 1)), r"height: .*ascending order, got \(2, 1\)"),
        (([1.0], (0, np.inf)), "height: expected finite limits"),
    ],
)
def test_what_is_no_scalar(arguments, message):
    with pytest.raises(InputError, match=message):
        Scalar("height", *arguments)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"kind": "lines"}, "a: expected a kind among points, balls, mesh, segments, got 'lines'"),
        ({"positions": np.empty((0, 3))}, r"a: expected finite positions \(N, 3\) with N >= 1"),
        ({"positions": np.eye(2)}, r"a: .*got shape \(2, 2\)"),
        ({"positions": np.full((1, 3), np.inf)}, "a: expected finite positions"),
        ({"kind": "balls"}, "a: balls need radii"),
        ({"radii": np.ones(3)}, "a: balls need radii, and other kinds have none"),
        ({"kind": "balls", "radii": [1, 2]}, "a: expected 3 finite radii of at least 0"),
        ({"kind": "balls", "radii": [1, 2, -1]}, "a: expected 3 finite radii of at least 0"),
        ({"kind": "mesh"}, "a: a mesh and segments need elements"),
        ({"elements": [[0, 1, 2]]}, "a: a mesh and segments need elements, and other kinds have none"),
        ({"kind": "segments", "elements": [[0, 1, 2]]}, r"a: expected elements \(T, 2\), got shape \(1, 3\)"),
        ({"kind": "mesh", "elements": [[0, 1, 3]]}, r"a: elements must be indices in \[0, 3\)"),
        ({"scalars": [Scalar("height", [1.0])]}, "a: 1 values of height for 3"),
        ({"opacity": 0.0}, r"a: expected an opacity in \(0, 1\]"),
        ({"size": 0.0}, "positive size"),
    ],
)
def test_what_is_no_layer(changes, message):
    with pytest.raises(InputError, match=message):
        layer(**changes)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([],), "s: a scene needs at least one layer"),
        (([layer(), layer()],), "s: layers need names of their own, got a, a"),
        (([layer()], "x"), "s: expected y or z to be up, got 'x'"),
    ],
)
def test_what_is_no_scene(arguments, message):
    with pytest.raises(InputError, match=message):
        Scene("s", *arguments)
