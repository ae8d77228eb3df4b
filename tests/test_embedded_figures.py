import base64
import io

import numpy as np
import pytest
from PIL import Image

from morphoskel.errors import InputError
from morphoskel.reporting.page import embedded_figures
from morphoskel.reporting.page.embedded_figures import FigureSource, compress_picture, embed_figures


def source(folder, name, pixels):
    Image.fromarray(pixels).save(folder / f"{name}.png")
    return FigureSource(name, name, "Caption.", folder / f"{name}.png")


def noise(height, width, channels=3):
    return np.random.default_rng(0).integers(0, 256, (height, width, channels), dtype=np.uint8)


def opened(content):
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGB")).astype(int)


def test_a_simple_picture_stays_exactly_as_it_is(tmp_path):
    pixels = np.repeat(np.arange(200, dtype=np.uint8)[:, None, None], 300, axis=1).repeat(3, axis=2)
    content, width, height = compress_picture(source(tmp_path, "a", pixels).path, 100_000)
    assert (width, height) == (300, 200)
    np.testing.assert_array_equal(opened(content), pixels)


def test_a_large_picture_becomes_as_small_as_the_page_allows(tmp_path):
    path = source(tmp_path, "a", np.full((100, 2500, 3), 200, dtype=np.uint8)).path
    assert compress_picture(path, 100_000)[1:] == (2000, 80)


def test_bytes_are_bounded_by_quality_then_by_size(tmp_path, monkeypatch):
    monkeypatch.setattr(embedded_figures, "FEWEST_PIXELS", 60)
    path = source(tmp_path, "a", noise(120, 150)).path
    sizes = []
    for most in (60_000, 20_000, 6_000):
        content, width, height = compress_picture(path, most)
        assert len(content) <= most
        assert abs(width / height - 1.25) < 0.03
        sizes.append(width)
    assert sizes[:2] == [150, 150]
    assert 60 <= sizes[2] < 150
    assert compress_picture(path, 10)[1] == 60  # it cannot be as small as that


def test_transparent_parts_are_white(tmp_path):
    pixels = np.zeros((20, 20, 4), dtype=np.uint8)
    pixels[:, 10:] = (255, 0, 0, 255)
    content, *_ = compress_picture(source(tmp_path, "a", pixels).path, 100_000)
    assert opened(content)[0, [0, 15]].tolist() == [[255, 255, 255], [255, 0, 0]]


def test_all_pictures_together_are_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr(embedded_figures, "ALL_BYTES", 60_000)
    figures = embed_figures([source(tmp_path, name, noise(150, 150)) for name in "abc"])
    contents = [base64.b64decode(figure.address.partition(",")[2]) for figure in figures]
    assert sum(map(len, contents)) <= 60_000
    for figure, content in zip(figures, contents, strict=True):
        assert opened(content).shape == (figure.height, figure.width, 3)


def test_what_cannot_be_shown_is_refused(tmp_path):
    good = source(tmp_path, "a", noise(4, 4))
    with pytest.raises(InputError, match="names of their own, got a, a"):
        embed_figures([good, good])
    (tmp_path / "b.png").write_bytes(b"no picture")
    for name in ("b", "absent"):
        with pytest.raises(InputError, match=rf"{name}\.png: cannot be read as a picture"):
            compress_picture(tmp_path / f"{name}.png", 1000)
