import numpy as np
import pytest
from PIL import Image
from solids import sphere_cloud

from morphoskel.reporting.render import View
from morphoskel.reporting.sample_picture import draw_sample, nearness

CLOUD = sphere_cloud(400)


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"), dtype=float) / 255


def is_blue(picture):
    return (picture[..., 2] > picture[..., 0] + 0.2).sum()


def test_chosen_points_stand_out_from_a_grey_cloud(tmp_path):
    shares = []
    for count in (10, 60):
        draw_sample(tmp_path / "a.png", CLOUD, np.arange(count), None, title="ball", view=View(pixels=300))
        shares.append(is_blue(pixels(tmp_path / "a.png")))
    assert 3 * shares[0] < shares[1]


def test_colours_show_the_local_feature_size(tmp_path):
    chosen = np.argsort(CLOUD.points[:, 1])[:30]
    for name, size in (("thin", 0.1), ("thick", 1.0)):
        sizes = np.full(400, 1.0)
        sizes[chosen] = size
        draw_sample(tmp_path / f"{name}.png", CLOUD, chosen, sizes, title="ball", view=View(pixels=300))
    for name, yellow_is_there in (("thin", False), ("thick", True)):
        picture = pixels(tmp_path / f"{name}.png")
        picture = picture[:, : picture.shape[1] * 3 // 4]  # without the colour bar
        yellow = (picture[..., 0] > 0.8) & (picture[..., 1] > 0.7) & (picture[..., 2] < 0.5)
        assert yellow.any() == yellow_is_there


def test_a_flat_cloud_and_one_on_its_skeleton_can_be_drawn(tmp_path):
    flat = type(CLOUD)(CLOUD.points * [1, 0, 0])
    draw_sample(tmp_path / "a.png", flat, np.arange(5), np.zeros(400), title="line", view=View(pixels=200))
    assert pixels(tmp_path / "a.png").min() < 0.5


def test_the_nearest_point_is_at_one_and_the_farthest_at_zero():
    front = View(azimuth=0, elevation=0)
    assert nearness(np.array([[5.0, 1, 2], [0, 0, -2], [0, 9, 0]]), front) == pytest.approx([1, 0, 0.5])
    assert nearness(np.ones((2, 3)), front) == pytest.approx([0, 0])
