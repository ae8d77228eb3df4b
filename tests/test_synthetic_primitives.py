import manifold3d
import numpy as np
import pytest

from morphoskel.datasets.synthetic import primitives
from morphoskel.datasets.synthetic.curves import arc, embed, smooth_path
from morphoskel.errors import ShapeError

CURVE = smooth_path([(0.0, 0.0, 0.0), (0.0, 1.0, 0.2), (0.5, 1.5, 1.0)], 20)
SOLIDS = {
    "box": lambda: primitives.box((1.0, 2.0, 3.0)),
    "rounded_box": lambda: primitives.rounded_box((1.0, 2.0, 0.1), radius=0.5),
    "slab": lambda: primitives.slab(1.0, 0.1, 2.0, (0.0, 0.0, 0.0), 0.3),
    "ball": lambda: primitives.ball((1.0, 2.0, 0.5)),
    "rod": lambda: primitives.rod((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.2, 0.1),
    "beam": lambda: primitives.beam((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), 0.2, 0.1, 0.5),
    "lathe": lambda: primitives.lathe([(0.0, 0.0), (1.0, 0.0), (0.5, 1.0), (0.0, 1.0)], "x"),
    "lathe_shell": lambda: primitives.lathe_shell([(1.0, 0.0), (0.8, 1.0), (0.0, 1.2)], 0.05),
    "prism": lambda: primitives.prism([(0.0, 0.0), (1.0, 0.0), (0.0, 2.0)], 0.1, "x"),
    "tube": lambda: primitives.tube(CURVE, 0.1),
    "loft": lambda: primitives.loft(np.stack([embed(arc((0, 0), (1, 1), (0, 330), 12), "z", z) for z in (0.0, 1.0)])),
    "hull": lambda: primitives.hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_every_primitive_is_one_closed_solid(name):
    solid = SOLIDS[name]()
    assert solid.status() == manifold3d.Error.NoError
    assert solid.volume() > 0
    assert len(solid.decompose()) == 1
    assert solid.genus() == 0


def test_box_and_prism_have_their_exact_volume_and_place():
    assert primitives.box((1, 2, 3), (1, 1, 1)).bounding_box() == (0.5, 0.0, -0.5, 1.5, 2.0, 2.5)
    for outline in ([(0, 0), (1, 0), (0, 2)], [(0, 2), (1, 0), (0, 0)]):
        prism = primitives.prism(outline, 0.5, "y", 3.0)
        assert prism.volume() == pytest.approx(0.5)
        assert prism.bounding_box() == pytest.approx((0.0, 2.75, 0.0, 1.0, 3.25, 2.0))


def test_round_solids_approach_the_volume_of_theory():
    assert primitives.ball((1.0, 2.0, 3.0), segments=64).volume() == pytest.approx(8 * np.pi, rel=0.01)
    cone = primitives.rod((0, 0, 0), (0, 0, 3), 2.0, 1.0, segments=128)
    assert cone.volume() == pytest.approx(7 * np.pi, rel=0.01)
    torus_half = primitives.tube(embed(arc((0, 0), (1, 1), (0, 180), 90), "z"), 0.1, segments=48)
    assert torus_half.volume() == pytest.approx(np.pi * np.pi * 0.01, rel=0.02)


def test_rod_and_lathe_point_along_their_axis():
    low, high = np.split(np.array(primitives.rod((0, 1, 0), (0, 4, 0), 0.1).bounding_box()), 2)
    assert (low[1], high[1]) == pytest.approx((1.0, 4.0))
    for axis, index in (("x", 0), ("y", 1), ("z", 2)):
        solid = primitives.lathe([(0, 1), (0.2, 1), (0.2, 3), (0, 3)], axis, (10.0, 10.0, 10.0))
        bounds = np.array(solid.bounding_box())
        assert (bounds[index], bounds[index + 3]) == pytest.approx((11.0, 13.0))


def test_a_shell_is_hollow_and_open_where_its_profile_ends_away_from_the_axis():
    pipe = primitives.lathe_shell([(1.0, 0.0), (1.0, 2.0)], 0.1, 96)
    assert pipe.genus() == 1
    assert pipe.volume() == pytest.approx(np.pi * (1 - 0.9**2) * 2, rel=0.01)
    cup = primitives.lathe_shell([(1.0, 0.0), (1.0, 2.0), (0.0, 2.0)], 0.1, 96)
    assert cup.genus() == 0
    assert cup.volume() == pytest.approx(np.pi * ((1 - 0.9**2) * 1.9 + 0.1), rel=0.01)


def test_both_sides_are_mirror_images():
    right, left = primitives.both_sides(primitives.box((1, 1, 1), (2, 0, 0)))
    assert left.volume() == pytest.approx(right.volume())
    assert left.bounding_box() == pytest.approx((-2.5, -0.5, -0.5, -1.5, 0.5, 0.5))


def test_an_open_surface_is_refused():
    vertices = np.eye(3)
    with pytest.raises(ShapeError, match="not closed"):
        primitives._solid(vertices, np.array([[0, 1, 2]]))
