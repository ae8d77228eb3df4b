import numpy as np
import pandas as pd
import pytest
import torch
from shard_folders import both, pixels
from solids import sphere_cloud
from tiny_parts import tiny_parts, tiny_segmentation

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.networks.part_segmentation import save_segmentation
from morphoskel.reporting.figures.segmentation import (
    SegmentedShape,
    draw_segmentation,
    draw_segmentation_from_files,
)
from morphoskel.reporting.render import View

POINTS = sphere_cloud(500).points
TRUTH = np.where(POINTS[:, 1] > 0, 4, 5)
SMALL = View(azimuth=0, elevation=0, pixels=120)


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def shape(told):
    return SegmentedShape(POINTS, TRUTH, told, np.array([4, 5]))


def panels(path, columns):
    return np.array_split(pixels(path), columns, axis=1)


def is_red(picture):
    return ((picture[..., 0] > 0.25) & (picture[..., 1] < 0.3 * picture[..., 0])).mean()


def test_wrong_points_are_marked(tmp_path):
    upper_wrong = np.where(POINTS[:, 1] > 0.3, 5, TRUTH)
    draw_segmentation(both(tmp_path), {"ball": shape({"right": TRUTH, "wrong": upper_wrong})}, view=SMALL)
    truth, right, right_marks, wrong, wrong_marks = panels(tmp_path / "figure.png", 5)
    assert is_red(right_marks) == 0
    assert is_red(wrong_marks) > 0.1
    where = np.argwhere((wrong_marks[..., 0] > 0.25) & (wrong_marks[..., 1] < 0.3 * wrong_marks[..., 0]))
    assert where[:, 0].max() < 0.5 * wrong_marks.shape[0]  # the upper part
    blue = [((panel[..., 2] > 1.2 * panel[..., 0]) & (panel[..., 2] < 0.9)).mean() for panel in (truth, right, wrong)]
    assert blue[0] == pytest.approx(blue[1], abs=0.01)
    assert blue[2] < 0.8 * blue[0]
    assert (tmp_path / "figure.pdf").exists()


def test_a_part_of_another_category_is_black(tmp_path):
    draw_segmentation(both(tmp_path), {"ball": shape({"lost": np.full(500, 9)})}, view=SMALL)
    _, told, _ = panels(tmp_path / "figure.png", 3)
    assert (told < 0.02).all(axis=2).mean() > 0.3


@pytest.fixture
def files(tmp_path):
    write_cloud_set(tiny_parts(repeated=5), tmp_path / "clouds.npz")
    networks, evaluations = {}, {}
    for strategy, ratio in (("ms3d", 16), ("full", 1)):
        networks[strategy] = tmp_path / strategy / str(ratio) / "0" / "network.pt"
        networks[strategy].parent.mkdir(parents=True)
        save_segmentation(tiny_segmentation(), networks[strategy])
        evaluations[strategy] = tmp_path / f"{strategy}.csv"
        pd.DataFrame({"ratio": [ratio], "seed": [0], "labels": [2.6]}).to_csv(evaluations[strategy], index=False)
    return tmp_path / "clouds.npz", networks, evaluations


def test_networks_are_shown_side_by_side(tmp_path, files):
    draw_segmentation_from_files(both(tmp_path), *files, view=SMALL)
    picture = pixels(tmp_path / "figure.png")
    drawn = [(panel < 0.9).any(axis=2).mean() for panel in np.array_split(picture, 5, axis=1)]
    assert min(drawn) > 0.1
    told = np.array_split(picture, 5, axis=1)
    assert is_red(told[0]) < 0.001


def test_a_network_that_was_not_evaluated_is_refused(tmp_path, files):
    clouds, networks, evaluations = files
    with pytest.raises(InputError, match="no row of"):
        draw_segmentation_from_files(both(tmp_path), clouds, networks, {**evaluations, "ms3d": evaluations["full"]})


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_segmentation(both(tmp_path), {})
