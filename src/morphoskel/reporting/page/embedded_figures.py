"""Figures within the page: pictures made small enough to be held by it."""

from __future__ import annotations

import io
import logging
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.errors import InputError
from morphoskel.progress import track
from morphoskel.reporting.page.assets import data_uri

if TYPE_CHECKING:
    from PIL.Image import Image

logger = logging.getLogger(__name__)

MOST_PIXELS = 2000
"""Longest side of a picture in the page: as many as a printed page of text is wide at 300 dots an inch."""

MOST_BYTES = 450_000
"""Of one picture."""

ALL_BYTES = 5_000_000
"""Of all pictures."""

QUALITIES = (92, 84, 76)
"""Of pictures that are stored with loss, tried in this order; below, letters begin to blur."""

LOSSLESS_EFFORT = 50
"""What WebP calls quality of pictures without loss: how long it searches for a smaller file, out of 100."""

LOSSLESS_SHARE = 0.4
"""Of the size of a PNG file: less than the same picture takes as WebP without loss. Eight figures took 0.43 to 1.15."""

SHRINK = 0.8
"""Factor on both sides of a picture for which no quality is small enough."""

FEWEST_PIXELS = 300
"""Longest side below which a picture is not made smaller."""


@dataclass(frozen=True)
class FigureSource:
    """A figure of a run.

    Parameters
    ----------
    name
        Of its file; part of its address within the page.
    title, caption
        For readers; the caption is a paragraph of reStructuredText.
    path
        The PNG file.
    alternative
        What is seen, for readers who do not see it; the caption by default.
    """

    name: str
    title: str
    caption: str
    path: Path
    alternative: str = ""


@dataclass(frozen=True)
class EmbeddedFigure:
    """A figure as the page holds it.

    Parameters
    ----------
    source
        Where it comes from.
    address
        Address that holds the picture.
    width, height
        Of the picture in the page, in pixels.
    """

    source: FigureSource
    address: str
    width: int
    height: int


def embed_figures(sources: Sequence[FigureSource]) -> list[EmbeddedFigure]:
    """Make the pictures of a page: at most :data:`MOST_BYTES` each and :data:`ALL_BYTES` together.

    Raises
    ------
    InputError
        If a file is absent or no picture, or two figures have the same name.
    """
    names = [source.name for source in sources]
    if len(set(names)) < len(names):
        raise InputError(f"figures need names of their own, got {', '.join(names)}")
    most = min(MOST_BYTES, ALL_BYTES // max(len(sources), 1))
    figures = []
    for source in track(sources, "pictures of the page", unit="picture"):
        content, width, height = compress_picture(source.path, most)
        figures.append(EmbeddedFigure(source, data_uri(content, "image/webp"), width, height))
    return figures


def compress_picture(path: Path, most_bytes: int) -> tuple[bytes, int, int]:
    """Return a picture as WebP of at most so many bytes, with its width and height.

    It is stored without loss if that is small enough, else with the best quality that is, and smaller if none is.

    Parameters
    ----------
    path
        PNG file.
    most_bytes
        Size to keep to; a picture of :data:`FEWEST_PIXELS` is taken as it is.

    Raises
    ------
    InputError
        If the file is absent or no picture.
    """
    from PIL import Image as Images
    from PIL import UnidentifiedImageError

    try:
        with Images.open(path) as opened:
            picture = _on_white(opened)
    except (OSError, UnidentifiedImageError) as error:
        raise InputError(f"{path}: cannot be read as a picture ({error}); draw the figure again") from error
    longest = min(max(picture.size), MOST_PIXELS)
    smaller = _resized(picture, longest)
    content = b""
    if LOSSLESS_SHARE * path.stat().st_size <= most_bytes:  # else seconds would be lost on finding that out
        content = _webp(smaller, lossless=True, quality=LOSSLESS_EFFORT)
    while not 0 < len(content) <= most_bytes:
        smaller = _resized(picture, longest)
        for quality in QUALITIES:
            content = _webp(smaller, lossless=False, quality=quality)
            if len(content) <= most_bytes:
                break
        if longest <= FEWEST_PIXELS:
            break
        longest = max(int(longest * SHRINK), FEWEST_PIXELS)
    logger.info("%s: %d x %d pixels, %d bytes", path.name, *smaller.size, len(content))
    return content, *smaller.size


def _on_white(picture: Image) -> Image:
    """Return the picture on the white that figures are drawn for."""
    from PIL import Image as Images

    if "A" not in picture.getbands() and "transparency" not in picture.info:
        return picture.convert("RGB")
    layered = picture.convert("RGBA")
    return Images.alpha_composite(Images.new("RGBA", layered.size, "white"), layered).convert("RGB")


def _resized(picture: Image, longest: int) -> Image:
    from PIL.Image import Resampling

    scale = longest / max(picture.size)
    if scale >= 1:
        return picture
    size = (max(round(picture.width * scale), 1), max(round(picture.height * scale), 1))
    return picture.resize(size, Resampling.LANCZOS, reducing_gap=3.0)


def _webp(picture: Image, *, lossless: bool, quality: int) -> bytes:
    stream = io.BytesIO()
    picture.save(stream, "WEBP", lossless=lossless, quality=quality)
    return stream.getvalue()
