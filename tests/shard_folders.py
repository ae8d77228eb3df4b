"""Folders as a stage leaves them for one shard, and the pixels of figures drawn from them."""

from pathlib import Path

import numpy as np
from PIL import Image

from morphoskel.chain.status import Status, write_status
from morphoskel.datasets.manifest import ShapeRecord, write_manifest
from morphoskel.formats import write_mesh_ply, write_skeleton_ply
from morphoskel.shapes import Mesh, Skeleton


def write_shard(folder: Path, results: dict[str, Skeleton | Mesh | str]) -> Path:
    """Write one file a shape; words are the stage at which the shape failed."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for shape, result in results.items():
        failed = isinstance(result, str)
        stage = result if failed else "stage"
        rows.append(Status(shape, "any", "failed" if failed else "ok", stage, "boom" * failed, 1, 0.1, 0.2, ""))
        if isinstance(result, Skeleton):
            write_skeleton_ply(folder / f"{shape}.ply", result)
        elif isinstance(result, Mesh):
            write_mesh_ply(folder / f"{shape}.ply", result)
    write_status(folder, rows)
    return folder


def write_shapes(path: Path, shapes: dict[str, tuple[str, Path]]) -> Path:
    """Write a manifest with the category and the file of each shape, all in the split test."""
    rows = [ShapeRecord(shape, category, "test", 0, file, "0" * 64) for shape, (category, file) in shapes.items()]
    write_manifest(path, rows)
    return path


def pixels(path: Path) -> np.ndarray:
    """Return a PNG as ``(H, W, 3)`` in [0, 1]."""
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"), dtype=float) / 255


def both(folder: Path) -> list[Path]:
    """Return the files of a figure."""
    return [folder / "figure.png", folder / "figure.pdf"]
