"""Which shapes a figure shows, and where their results are among the folders of the shards."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from morphoskel.chain.status import FILE_NAME, read_status
from morphoskel.datasets.manifest import ShapeRecord
from morphoskel.formats import read_skeleton_ply
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.shapes import Mesh, Skeleton

NOT_THERE = "not computed"


def choose_shapes(
    ids: Sequence[str], categories: Sequence[str], *, wanted: Sequence[str] = (), count: int | None = None
) -> dict[str, int]:
    """Return one shape a category: those wanted in that order, then the first of every other category.

    Parameters
    ----------
    ids, categories
        Of the shapes of a split, in its order.
    wanted
        Ids of shapes, or parts of the names of categories in small letters; what the data set lacks is passed over.
        Shapes named by their ids may be of one category.
    count
        Most shapes to return; all if ``None``.

    Returns
    -------
    dict
        For the title of each shape its place among `ids`. The title is its category, or the id of a further shape of
        the category.
    """
    chosen: dict[str, int] = {}
    for name in (*wanted, ""):
        for place, (shape, category) in enumerate(zip(ids, categories, strict=True)):
            is_next = shape == name or (name in category.lower() and category not in chosen)
            if is_next and place not in chosen.values():
                chosen[shape if category in chosen else category] = place
    return dict(list(chosen.items())[:count])


def choose_records(
    records: Sequence[ShapeRecord], *, wanted: Sequence[str] = (), count: int | None = None
) -> dict[str, ShapeRecord]:
    """Return shapes of a manifest by title, see :func:`choose_shapes`."""
    ids, categories = [record.id for record in records], [record.category for record in records]
    places = choose_shapes(ids, categories, wanted=wanted, count=count)
    return {title: records[place] for title, place in places.items()}


def find_result(folders: Sequence[Path], shape: str) -> Path | str:
    """Return the file of a shape among the folders of a stage's shards, or the words to show in its place."""
    for folder in folders:
        rows = read_status(folder) if (folder / FILE_NAME).exists() else []
        for row in rows:
            if row.id == shape and row.status == "failed":
                return "failed at\n" + row.stage.replace("_", "\n")
        if (folder / f"{shape}.ply").exists():
            return folder / f"{shape}.ply"
    return NOT_THERE


def find_skeleton(folders: Sequence[Path], shape: str) -> Skeleton | str:
    """Return the skeleton of a shape, or the words to show in its place."""
    found = find_result(folders, shape)
    if isinstance(found, str):
        return found
    skeleton = read_skeleton_ply(found)
    return skeleton if len(skeleton) else "no balls"


def find_surface(folders: Sequence[Path], shape: str) -> Mesh | str:
    """Return the surface of a shape, or the words to show in its place."""
    found = find_result(folders, shape)
    return found if isinstance(found, str) else read_mesh(found)
