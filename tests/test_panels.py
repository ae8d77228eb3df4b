import numpy as np
import pytest
from scipy import ndimage
from shard_folders import both, pixels

from morphoskel.errors import InputError
from morphoskel.reporting.figures.panels import Row, Scale, crop_alike, draw_rows


def blobs(picture, colour=(0, 0, 0)):
    """Return height and width of every large blob of a colour, from left to right."""
    labels, _ = ndimage.label(np.abs(picture - colour).max(axis=2) < 0.1)
    boxes = sorted(ndimage.find_objects(labels), key=lambda box: box[1].start)
    sizes = [(box[0].stop - box[0].start, box[1].stop - box[1].start) for box in boxes]
    return [size for size in sizes if min(size) > 40]


def black(height, width):
    return np.zeros((height, width, 3))


def test_pictures_of_one_size_are_drawn_at_one_size(tmp_path):
    rows = [Row([black(50, 100)] * 3, name="upper", titles=["a", "b", "c"]), Row([black(50, 100)] * 3, notes=["x"])]
    draw_rows(both(tmp_path), rows, width=4.0)
    found = blobs(pixels(tmp_path / "figure.png"))
    assert len(found) == 6
    assert np.ptp(found, axis=0).max() <= 1
    assert found[0][0] / found[0][1] == pytest.approx(0.5, abs=0.02)
    assert (tmp_path / "figure.pdf").read_bytes().startswith(b"%PDF")


def test_a_picture_fills_its_panel_in_one_direction_and_keeps_its_shape(tmp_path):
    draw_rows(both(tmp_path), [Row([black(100, 100), black(20, 100), black(100, 50)])], width=3.0)
    square, flat, slim = blobs(pixels(tmp_path / "figure.png"))
    assert square[0] == pytest.approx(square[1], abs=2)
    assert flat == pytest.approx((square[0] / 5, square[1]), abs=2)
    assert slim == pytest.approx((1.15 * square[1], 1.15 * square[1] / 2), abs=2)  # as tall as a panel may be


def test_words_stand_where_there_is_no_picture(tmp_path):
    dark = []
    for words in ("", "failed at\nocclusion"):
        draw_rows(both(tmp_path), [Row([np.ones((10, 10, 3)), words])], width=2.0)
        picture = pixels(tmp_path / "figure.png")
        dark.append((picture[:, picture.shape[1] // 2 :] < 0.5).sum())
    assert dark[0] == 0 < dark[1]


@pytest.mark.parametrize("of_all", [True, False])
def test_a_scale_is_drawn_at_the_right(tmp_path, of_all):
    scale = Scale(0, 2, "viridis", "size")
    rows = [Row([black(10, 10)] * 2, scale=None if of_all else scale)]
    draw_rows(both(tmp_path), rows, scale=scale if of_all else None, width=3.0)
    picture = pixels(tmp_path / "figure.png")
    where = np.argwhere(np.abs(picture - (0.993, 0.906, 0.144)).max(axis=2) < 0.02)
    assert where[:, 1].min() > 0.75 * picture.shape[1]


def test_long_names_are_broken_into_lines_that_do_not_meet(tmp_path):
    rows = [Row([black(100, 100)], name="Coverage Axis++, repaired Poisson")] * 2
    dark = {}
    for level in (False, True):
        draw_rows(both(tmp_path), rows, width=1.5, level_names=level)
        picture = pixels(tmp_path / "figure.png")
        black_part = (picture < 0.1).all(axis=2).mean(axis=0)
        names = (picture[:, : np.argmax(black_part > 0.7)] < 0.5).any(axis=2)
        assert not names[:, :3].any()  # nothing is cut off at the edge
        dark[level] = np.flatnonzero(names.any(axis=1))
    assert np.diff(dark[True]).max() > 100  # between the two names
    assert np.ptp(dark[True]) < np.ptp(dark[False])


def test_pictures_are_cropped_alike_and_words_stay_in_place():
    pictures = [np.ones((30, 30, 3)) for _ in "ab"]
    pictures[0][10, 10] = pictures[1][20, 20] = 0
    first, words, second = crop_alike([pictures[0], "failed", pictures[1]])
    assert words == "failed"
    assert first.shape == second.shape == (23, 23, 3)
    assert (first[6, 6] == 0).all()
    assert crop_alike(["failed"]) == ["failed"]


@pytest.mark.parametrize("rows", [[], [Row([])]])
def test_nothing_to_draw_is_refused(tmp_path, rows):
    with pytest.raises(InputError, match="at least one shape"):
        draw_rows(both(tmp_path), rows)
