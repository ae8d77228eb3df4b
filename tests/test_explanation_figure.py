import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.reporting.explanation_figure import draw_explanations, unexplained
from morphoskel.reporting.render import View
from morphoskel.shapes import Skeleton

EXPLAINED = Skeleton(np.zeros((1, 3)), [1.0])
SMALL = Skeleton(np.zeros((1, 3)), [0.4])


def test_a_point_is_explained_by_the_ball_that_it_lies_on():
    cloud = sphere_cloud(50)
    assert unexplained(cloud, EXPLAINED) == pytest.approx(np.zeros(50), abs=1e-12)
    assert unexplained(cloud, SMALL) == pytest.approx(np.full(50, 0.6))


def test_what_is_not_explained_is_darker(tmp_path):
    from PIL import Image

    brightness = []
    for skeleton in (EXPLAINED, SMALL):
        clouds = {"ball": sphere_cloud(300)}
        draw_explanations(tmp_path / "a.png", clouds, {"same": [skeleton]}, view=View(pixels=100))
        with Image.open(tmp_path / "a.png") as picture:
            brightness.append(np.asarray(picture.convert("L"), dtype=float).mean())
    assert brightness[1] < brightness[0] - 0.3


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_explanations(tmp_path / "a.png", {}, {"whole": []})
