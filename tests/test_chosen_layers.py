import numpy as np
import pytest
from small_run import write_chosen
from solids import box

from morphoskel.errors import InputError
from morphoskel.reporting.page.chosen_layers import chosen_layers
from morphoskel.sampling.choice import FIXED, Choice, write_choice
from morphoskel.shapes import PointCloud

CLOUDS = {name: PointCloud(box(1.0, 0.6, 0.4).vertices * scale + 5) for name, scale in (("a", 1.0), ("b", 30.0))}


@pytest.fixture
def folder(tmp_path):
    write_chosen(tmp_path, CLOUDS)
    return tmp_path


def layers(folder, shape="b", ratio=2):
    samples = {"MS3D": folder / "samples/ms3d", "FPS": folder / "samples/fps"}
    return chosen_layers(shape, folder / "clouds.npz", samples, ratio)


def test_chosen_points_stand_where_the_cloud_has_them_each_once(folder):
    ours, other = layers(folder)
    assert (ours.name, ours.visible, ours.detail) == ("points of MS3D", True, "3 of 8 points")
    assert (other.name, other.visible, other.detail) == ("points of FPS", False, "4 of 8 points")
    np.testing.assert_allclose(ours.positions, CLOUDS["b"].points[[0, 2, 7]], atol=1e-5)
    np.testing.assert_allclose(other.positions, CLOUDS["b"].points[[1, 3, 5, 7]], atol=1e-5)


def test_a_shape_that_was_not_sampled_has_no_layer(folder):
    assert layers(folder, shape="c") == []
    none = np.full((1, 2, 4), -1, dtype=np.int32)
    (folder / "samples/ms3d/2_0_drawn.npz").unlink()
    write_choice(Choice(none, none[:, :, 0]), folder / f"samples/ms3d/2_0_{FIXED}.npz")
    assert [(layer.name, layer.visible) for layer in layers(folder)] == [("points of FPS", True)]


def test_points_of_another_ratio_are_refused(folder):
    with pytest.raises(InputError, match=r"expected 4_0_drawn.npz or 4_0_fixed.npz, found 2_0_drawn.npz"):
        layers(folder, ratio=4)
