"""What every data set offers, and what their modules share."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from morphoskel.errors import DatasetError

if TYPE_CHECKING:
    from morphoskel.datasets.manifest import Entry
    from morphoskel.shapes import PointCloud


@runtime_checkable
class Dataset(Protocol):
    """A set of shapes on disk, in its owner's layout."""

    @property
    def how_to_get(self) -> str:
        """What to fetch, from where, and where to put it."""
        ...

    def list_shapes(self) -> list[Entry]:
        """Return all shapes of all splits; reads lists and folders, but no shape.

        Raises
        ------
        DatasetError
            If the data set is absent or incomplete.
        """
        ...

    def counts(self) -> dict[str, int]:
        """Return the number of shapes of each split, equal to what :meth:`list_shapes` returns, but cheaper.

        Raises
        ------
        DatasetError
            If the data set is absent or incomplete.
        """
        ...

    def load(self, path: Path) -> PointCloud:
        """Read the shape whose entry has this `path`, in the data set's own units.

        Raises
        ------
        InputError
            If the file is broken.
        """
        ...


def check_root(root: Path, how_to_get: str, *expected: str) -> None:
    """Raise unless `root` is a folder that holds everything `expected`.

    Parameters
    ----------
    root
        The folder of the data set.
    how_to_get
        Told to the user if something is missing.
    expected
        Names of files or folders inside `root`.

    Raises
    ------
    DatasetError
        If `root` or something in it is missing.
    """
    if not root.is_dir():
        raise DatasetError(f"{root}: the data set's folder does not exist. {how_to_get}")
    for name in expected:
        if not (root / name).exists():
            raise DatasetError(f"{root / name}: missing from the data set. {how_to_get}")


def choose_categories(wanted: Sequence[str] | None, legal: Iterable[str]) -> tuple[str, ...]:
    """Return the categories to use, in the order of `legal`.

    Parameters
    ----------
    wanted
        Names the user chose; ``None`` stands for all.
    legal
        Names that the data set has.

    Raises
    ------
    DatasetError
        If a name is unknown; the message holds the nearest match and all legal names.
    """
    names = tuple(legal)
    if wanted is None:
        return names
    for name in wanted:
        if name not in names:
            folded = {legal_name.casefold(): legal_name for legal_name in names}
            near = difflib.get_close_matches(name.casefold(), folded, n=1, cutoff=0.5)
            hint = f"; did you mean {folded[near[0]]!r}?" if near else "."
            raise DatasetError(f"categories: unknown name {name!r}{hint} Legal names: {', '.join(names)}")
    if not wanted:
        raise DatasetError(f"categories: the list is empty; leave it out for all of {', '.join(names)}")
    return tuple(name for name in names if name in wanted)


def read_lines(path: Path) -> list[str]:
    """Return the lines of a list file without blank ones and without surrounding white space.

    Raises
    ------
    DatasetError
        If the file cannot be read as text.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError(f"{path}: cannot be read as a list of shapes ({error})") from error
    return [line.strip() for line in text.splitlines() if line.strip()]
