import numpy as np
import pytest
from solids import ball

from morphoskel.reporting.figures.ball_panels import POINT_COLOUR, draw_balls, draw_in_surface, joint_bounds
from morphoskel.reporting.render import View, ball_bounds
from morphoskel.shapes import Skeleton

BALLS = Skeleton([[-2.0, 0, 0], [1, 0, 0]], [0.5, 1.0])
FRONT = View(azimuth=0, elevation=0, pixels=120)


def hue(picture):
    """Return the mean colour of what is drawn left and right, at full brightness."""
    halves = np.split(picture, 2, axis=1)
    means = [half[(half < 1).any(axis=2)].mean(axis=0) for half in halves]
    return np.array([mean / mean.max() for mean in means])


def test_boxes_are_joined():
    boxes = np.sort(np.random.default_rng(0).normal(size=(5, 2, 3)), axis=1)
    joint = joint_bounds(boxes)
    for axis in range(3):
        assert joint[0, axis] == min(box[0][axis] for box in boxes)
        assert joint[1, axis] == max(box[1][axis] for box in boxes)


def test_colours_are_relative_to_the_largest_ball_or_to_the_radius_named():
    usual = draw_balls(BALLS, FRONT, ball_bounds(BALLS))
    twice = Skeleton(2 * BALLS.points, 2 * BALLS.radii)
    assert np.abs(draw_balls(twice, FRONT, ball_bounds(twice)) - usual).max() < 0.01
    assert hue(usual)[1] == pytest.approx([1, 0.91, 0.15], abs=0.05)  # yellow, the end of the scale
    darker = draw_balls(BALLS, FRONT, ball_bounds(BALLS), largest=2.0)
    assert hue(darker)[1] == pytest.approx(hue(usual)[0], abs=0.06)


def test_points_and_veil_are_drawn_over_the_balls():
    bounds = ball_bounds(BALLS)
    plain = draw_balls(BALLS, FRONT, bounds)
    dotted = draw_balls(BALLS, FRONT, bounds, points=np.array([[1.0, 0, 1.2], [1, 0, -0.5]]))
    changed = (plain != dotted).any(axis=2)
    assert 0 < changed.sum() < 30  # one of the two is inside a ball
    colour = dotted[changed].min(axis=0)
    assert np.argmax(colour) == np.argmax(POINT_COLOUR)
    veiled = draw_balls(BALLS, FRONT, bounds, veil=ball(radius=0.8, subdivisions=3))
    assert (plain != veiled).any(axis=2).sum() > 500


def test_words_stay_in_the_place_of_a_skeleton_and_leave_out_a_surface():
    bounds, surface = ball_bounds(BALLS), ball(radius=0.8, subdivisions=3)
    assert draw_in_surface(surface, "failed", FRONT, bounds) == "failed"
    veiled = draw_in_surface(surface, BALLS, FRONT, bounds, largest=2.0)
    assert np.array_equal(veiled, draw_balls(BALLS, FRONT, bounds, largest=2.0, veil=surface))
    assert np.array_equal(draw_in_surface("failed", BALLS, FRONT, bounds), draw_balls(BALLS, FRONT, bounds))
