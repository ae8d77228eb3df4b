import numpy as np
import pytest

from morphoskel.skeleton.l1_medial.recentring import recentre, section_centre
from tests.tubes import CYLINDER, distance_to_axes, noisy_tubes


def ellipse(generator, centre, first, second, count=200):
    angles = generator.beta(0.7, 0.9, count) * 2 * np.pi  # denser on one side
    return np.column_stack([first * np.cos(angles), second * np.sin(angles)]) + centre


@pytest.mark.parametrize(("first", "second"), [(1.0, 1.0), (1.2, 0.9)])
def test_finds_the_centre_of_an_uneven_section(first, second):
    section = ellipse(np.random.default_rng(0), [0.4, -0.3], first, second)
    assert np.linalg.norm(section.mean(axis=0) - [0.4, -0.3]) > 0.05  # which the mean of the points is not
    assert section_centre(section) == pytest.approx([0.4, -0.3], abs=0.02)


@pytest.mark.parametrize(
    "section",
    [
        ellipse(np.random.default_rng(0), [0.1, 0.1], 1.0, 0.2),  # a sheet
        ellipse(np.random.default_rng(0), [5.0, 0.0], 1.0, 1.0),  # does not surround the node
        np.array([[1.0, 0], [0.5, 0.5], [0, 1], [-0.5, 0.5], [-1, 0], [0.2, 0.1]]),  # open on one side
    ],
)
def test_stays_where_the_section_is_not_that_of_a_tube(section):
    assert section_centre(section).tolist() == [0, 0]


def test_nodes_move_to_the_axis_but_not_along_it():
    points = noisy_tubes(CYLINDER, 2000, 0).points
    axis = np.linspace(CYLINDER[0][0] + [0, 0.05, 0], CYLINDER[0][1] - [0, 0.05, 0], 12)
    nodes = axis + np.random.default_rng(0).uniform(-0.015, 0.015, (12, 3)) * [1, 0, 1]
    tangents = np.tile([0.0, 2.0, 0], (12, 1))
    tangents[5] = 0
    moved = recentre(nodes, tangents, points)
    assert np.array_equal(moved[5], nodes[5])
    others = np.arange(12) != 5
    assert distance_to_axes(moved[others], CYLINDER).max() < 0.3 * distance_to_axes(nodes[others], CYLINDER).mean()
    np.testing.assert_allclose(moved[:, 1], nodes[:, 1])
