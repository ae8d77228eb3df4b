import numpy as np
import pytest
from solids import ball

from morphoskel.reporting.render import View, render_balls, render_mesh
from morphoskel.reporting.skeleton_picture import draw_skeleton
from morphoskel.shapes import Mesh, Skeleton

VIEW = View(azimuth=0, elevation=0, pixels=120)
HALF_BALL = Skeleton([[0.0, 0.0, 0.0]], [0.5], [0.0])


def test_a_ball_is_drawn_as_a_disc_of_its_size():
    drawn = (render_mesh(ball(), VIEW) < 1).any(axis=2)
    assert drawn.mean() == pytest.approx(np.pi / 4 / 1.04**2, abs=0.01)
    rows, columns = np.nonzero(drawn)
    assert np.allclose([rows.mean(), columns.mean()], 59.5, atol=1)


def test_light_falls_from_above():
    picture = render_mesh(ball(), VIEW).mean(axis=2)
    assert picture[30, 60] > picture[90, 60] + 0.1


def test_balls_shine_through_the_surface_in_their_colour():
    picture = render_balls(HALF_BALL, np.array([[1.0, 0.0, 0.0]]), VIEW, under=ball())
    assert picture[60, 60, 0] > picture[60, 60, 1] + 0.3
    assert np.ptp(picture[60, 20]) < 0.2  # the veil alone is grey
    assert (picture[2, 2] == 1).all()


def test_the_nearest_triangle_hides_the_others_in_its_own_colour():
    square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    halves = np.array([[0, 1, 2], [0, 2, 3]])
    two = Mesh(np.vstack([square, square - [0, 0, 1]]), np.vstack([halves, halves + 4]))
    near_blue = np.array([[0.0, 0, 1], [0, 0, 1], [1, 0, 0], [1, 0, 0]])
    picture = render_mesh(two, VIEW, near_blue)
    assert (picture[60, 60] * [1, 1, 0] == 0).all()
    assert picture[60, 60, 2] > 0.5


def test_the_file_is_a_picture(tmp_path):
    from PIL import Image

    draw_skeleton(tmp_path / "ball.png", HALF_BALL, ball(), title="ball", view=VIEW)
    with Image.open(tmp_path / "ball.png") as picture:
        assert picture.width > picture.height > 200


def test_balls_without_a_surface_are_one_picture(tmp_path):
    from PIL import Image

    draw_skeleton(tmp_path / "both.png", HALF_BALL, ball(), title="ball", view=VIEW)
    draw_skeleton(tmp_path / "alone.png", HALF_BALL, None, title="ball", view=VIEW)
    with Image.open(tmp_path / "both.png") as both, Image.open(tmp_path / "alone.png") as alone:
        assert 200 < alone.width < 0.6 * both.width
