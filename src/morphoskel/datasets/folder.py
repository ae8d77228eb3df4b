"""A user's own meshes and clouds in a folder."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel.datasets.dataset import check_root, choose_categories
from morphoskel.datasets.manifest import Entry
from morphoskel.errors import ConfigError, DatasetError

if TYPE_CHECKING:
    from morphoskel.shapes import PointCloud

SPLIT = "test"
"""The one split that all shapes belong to: nothing is trained on them."""


class FolderDataset:
    """All files of a supported format below a folder.

    An entry's category is the name of the sub-folder of `root` in which the file lies, or ``shape`` for files directly
    in `root`. Its id is the path below `root` without suffix, with ``-`` for each ``/`` and ``_`` for each character
    that is not safe in file names. Where letters of other alphabets are replaced, which may be all that tells two files
    apart, eight digits made from the name follow. Two files with the same id are an error when the manifest is built.

    Parameters
    ----------
    root
        The folder.
    categories
        Categories to keep; ``None`` keeps all.
    recursive
        Look into sub-folders, too. Hidden files and folders are always passed over.
    suffixes
        Keep only files with these suffixes, for example ``[".ply"]``; ``None`` keeps all supported formats.
    points
        Number of points drawn from each mesh; clouds are read whole.
    seed
        Global seed of the sampling; each shape has its own stream.

    Raises
    ------
    ConfigError
        If a suffix is not supported.
    """

    def __init__(
        self,
        root: Path | str,
        categories: Sequence[str] | None = None,
        recursive: bool = True,
        suffixes: Sequence[str] | None = None,
        points: int = 10_000,
        seed: int = 0,
    ) -> None:
        from morphoskel.formats import SUPPORTED_SUFFIXES

        self.root = Path(root)
        self.categories = categories
        self.recursive = recursive
        self.suffixes = SUPPORTED_SUFFIXES if suffixes is None else tuple(suffix.lower() for suffix in suffixes)
        self.points = points
        self.seed = seed
        unknown = [suffix for suffix in self.suffixes if suffix not in SUPPORTED_SUFFIXES]
        if unknown:
            raise ConfigError(
                f"dataset.suffixes: {unknown[0]!r} is not supported; expected among {', '.join(SUPPORTED_SUFFIXES)}"
            )

    @property
    def how_to_get(self) -> str:
        """What to put where."""
        return f"Put your meshes or clouds ({', '.join(self.suffixes)}) into {self.root}, or set dataset.root."

    def list_shapes(self) -> list[Entry]:
        """Return all shapes; reads folders only."""
        files = self._files()
        chosen = choose_categories(self.categories, sorted({self._category(path) for path in files}))
        return [
            Entry(self._identify(path), self._category(path), SPLIT, path)
            for path in files
            if self._category(path) in chosen
        ]

    def counts(self) -> dict[str, int]:
        """Return the number of shapes, all in the split ``test``."""
        return {SPLIT: len(self.list_shapes())}

    def load(self, path: Path) -> PointCloud:
        """Read a cloud, or sample a mesh uniformly by area with a stream of its own."""
        from morphoskel.formats import read_cloud
        from morphoskel.seeds import derive_generator

        generator = derive_generator(self.seed, self._identify(path), "sample")
        return read_cloud(path, samples=self.points, generator=generator)

    def _files(self) -> list[Path]:
        """Return the files of the chosen formats, sorted."""
        check_root(self.root, self.how_to_get)
        files = sorted(self._walk())
        if not files:
            raise DatasetError(
                f"{self.root}: holds no file with a suffix {', '.join(self.suffixes)}. {self.how_to_get}"
            )
        return files

    def _walk(self) -> Iterator[Path]:
        for path in self.root.rglob("*") if self.recursive else self.root.iterdir():
            hidden = any(part.startswith(".") for part in path.relative_to(self.root).parts)
            if path.suffix.lower() in self.suffixes and not hidden and path.is_file():
                yield path

    def _category(self, path: Path) -> str:
        parts = path.relative_to(self.root).parts
        return parts[0] if len(parts) > 1 else "shape"

    def _identify(self, path: Path) -> str:
        name = unicodedata.normalize("NFC", "-".join(path.relative_to(self.root).with_suffix("").parts))
        safe = re.sub(r"^[+-]|[^A-Za-z0-9._+-]", "_", name)
        digits = hashlib.sha256(name.encode(errors="surrogateescape")).hexdigest()[:8]
        return safe if name.isascii() else f"{safe}-{digits}"
