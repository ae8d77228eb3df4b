import numpy as np
import pytest
from shard_folders import both, pixels
from solids import sphere_cloud
from tiny_clouds import tiny_clouds, tiny_priors

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import InputError
from morphoskel.reporting.figures.samples import draw_samples, draw_samples_from_files
from morphoskel.reporting.render import View
from morphoskel.sampling.choice import Choice, write_choice
from morphoskel.sampling.prior_set import write_prior_set

POINTS = sphere_cloud(200).points
SMALL = View(pixels=150)


def panels(folder, rows, columns):
    """Return the number of coloured pixels of every panel, ``(rows, columns)``, and that of dark ones of letters."""
    picture = pixels(folder / "figure.png")
    picture = picture[:, : int(picture.shape[1] * 0.88)]
    coloured = np.ptp(picture, axis=2) > 0.15
    dark = (picture < 0.3).all(axis=2)
    split = [[part for half in np.array_split(mask, rows) for part in np.array_split(half, columns, axis=1)]
             for mask in (coloured, dark)]  # fmt: skip
    return [np.array([part.sum() for part in parts]).reshape(rows, columns) for parts in split]


def test_more_points_are_coloured_the_more_are_chosen(tmp_path):
    chosen = {name: {count: np.arange(count, dtype=np.int32) for count in (4, 16)} for name in ("FPS", "MS3D")}
    draw_samples(both(tmp_path), POINTS, chosen, None, view=SMALL)
    coloured, _ = panels(tmp_path, 2, 2)
    assert (2.5 * coloured[:, 0] < coloured[:, 1]).all()
    assert coloured[0] == pytest.approx(coloured[1], rel=0.02)
    assert (tmp_path / "figure.pdf").exists()


def test_chosen_points_on_the_far_side_are_seen(tmp_path):
    depth = POINTS @ SMALL.axes()[2]
    chosen = {"near": {3: np.argsort(-depth)[:3]}, "far": {3: np.argsort(depth)[:3]}}
    draw_samples(both(tmp_path), POINTS, chosen, None, view=SMALL)
    near, far = panels(tmp_path, 2, 1)[0][:, 0]
    assert far == pytest.approx(near, rel=0.25)


def test_colours_show_the_local_feature_size(tmp_path):
    lowest = {"FPS": {20: np.argsort(POINTS[:, 1])[:20]}}
    yellow = []
    for sizes in (POINTS[:, 1] + 2, 2 - POINTS[:, 1]):
        draw_samples(both(tmp_path), POINTS, lowest, sizes, view=SMALL)
        picture = pixels(tmp_path / "figure.png")
        picture = picture[:, : int(picture.shape[1] * 0.88)]
        yellow.append(((picture[..., 0] > 0.5) & (picture[..., 2] < 0.3)).sum())
    assert yellow[0] == 0 < yellow[1]


@pytest.fixture
def files(tmp_path):
    clouds = tiny_clouds(shapes=4)
    write_cloud_set(clouds, tmp_path / "clouds.npz")
    write_prior_set(tiny_priors(clouds, failed=(1,)), tmp_path / "priors.npz")
    for sampler, kind, ratios in (("fps", "fixed", (4, 8)), ("ms3d", "drawn", (8,)), ("ms3d", "argmax", (8,))):
        for ratio in ratios:
            count = 40 // ratio
            indices = np.tile(np.arange(count, dtype=np.int32), (2, 4, 1))
            indices[:, :, -1] = 0 if sampler == "ms3d" else indices[:, :, -1]
            indices[:, 1] = -1 if sampler == "ms3d" else indices[:, 1]
            (tmp_path / sampler).mkdir(exist_ok=True)
            write_choice(Choice(indices, np.full((2, 4), count)), tmp_path / sampler / f"{ratio}_0_{kind}.npz")
    return tmp_path


@pytest.mark.parametrize(("shape", "chosen"), [("s0", True), ("s1", False)])
def test_what_was_not_chosen_is_said(files, shape, chosen):
    samples = {"fps": files / "fps", "ms3d": files / "ms3d"}
    draw_samples_from_files(
        both(files), files / "clouds.npz", samples, files / "priors.npz", wanted=[shape], view=SMALL
    )
    coloured, dark = panels(files, 2, 2)
    assert (coloured[0] > 0).all()
    assert (coloured[1, 0] > 0) == chosen
    assert coloured[1, 1] == 0  # no such ratio
    assert dark[1, 1] > 0


def test_nothing_to_draw_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_samples(both(tmp_path), POINTS, {}, None)
