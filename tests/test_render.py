import numpy as np
import pytest
from solids import ball

from morphoskel.reporting.render import Canvas, View, render_balls, render_mesh
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


def random_balls(count=60):
    generator = np.random.default_rng(0)
    centres = generator.uniform(-1, 1, (count, 3))
    return centres, generator.uniform(0.02, 0.5, count), generator.random((count, 3))


def naive_balls(canvas, centres, radii):
    """Return depth and ball, a ray, by looking at all balls from every ray."""
    steps = ((np.arange(canvas.side) + 0.5) / canvas.side * 2 - 1) * canvas.half
    where = (centres - canvas.centre) @ canvas.axes.T
    across, along = np.meshgrid(steps, -steps)
    height = radii**2 - (across[..., None] - where[:, 0]) ** 2 - (along[..., None] - where[:, 1]) ** 2
    depth = np.where(height >= 0, where[:, 2] + np.sqrt(np.maximum(height, 0)), -np.inf)
    return depth.max(axis=2), depth.argmax(axis=2)


def test_balls_are_those_that_every_ray_meets_first(monkeypatch):
    monkeypatch.setattr("morphoskel.reporting.render.FRAGMENTS", 500)  # many chunks
    centres, radii, colours = random_balls()
    canvas = Canvas(View(pixels=60), [[-1] * 3, [1] * 3])  # some balls leave the picture
    canvas.add_balls(centres, radii, colours)
    depth, ball = naive_balls(canvas, centres, radii)
    assert np.allclose(canvas.depth, depth)
    hit = np.isfinite(depth)
    assert hit.any()
    assert not hit.all()
    assert (canvas.colours[~hit] == 1).all()
    brightness = canvas.colours[hit] / colours[ball[hit]]
    assert np.allclose(brightness, brightness[:, :1])


def test_the_order_of_opaque_things_does_not_matter():
    centres, radii, colours = random_balls()
    pictures = []
    for steps in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        canvas = Canvas(View(pixels=60), [[-1.5] * 3, [1.5] * 3])
        parts = [
            lambda canvas=canvas: canvas.add_mesh(ball(), (0, 1, 0)),
            lambda canvas=canvas: canvas.add_balls(centres[:30], radii[:30], colours[:30]),
            lambda canvas=canvas: canvas.add_balls(centres[30:], radii[30:], colours[30:]),
        ]
        for step in steps:
            parts[step]()
        pictures.append(canvas.image())
    assert np.array_equal(pictures[0], pictures[1])
    assert np.array_equal(pictures[0], pictures[2])


def test_a_ball_and_a_mesh_of_it_look_alike():
    by_mesh = render_mesh(ball(), VIEW, (1.0, 0.5, 0.2))
    by_ball = render_balls(Skeleton([[0.0, 0, 0]], [1.0], [0.0]), (1.0, 0.5, 0.2), VIEW)
    assert np.abs(by_mesh - by_ball).mean() < 0.01


def test_points_have_the_size_that_is_asked_for_and_never_vanish():
    canvas = Canvas(VIEW, [[-1] * 3, [1] * 3])
    canvas.add_points(np.zeros((1, 3)), (0, 0, 0), size=0.1)
    assert (canvas.image() < 1).any(axis=2).mean() == pytest.approx(np.pi * 0.1**2, rel=0.1)
    canvas = Canvas(VIEW, [[-1] * 3, [1] * 3])
    canvas.add_points(np.full((1, 3), 0.5), (0, 0, 0), size=1e-9)
    assert canvas.image().min() < 1
