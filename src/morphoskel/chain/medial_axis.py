"""The reference medial axis of a shape: one of the user's, or computed from the closed surface."""

from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.chain.task import Details, Task
from morphoskel.errors import InputError
from morphoskel.formats import write_skeleton_ply
from morphoskel.formats.medial_axis_file import read_medial_axis
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.skeleton.medial_axis import medial_axis_of_mesh

HEAVY_IMPORTS = ("scipy.spatial", "morphoskel.chain.compiler", "morphoskel.skeleton.shrinking_ball_kernels")

SUFFIXES = ("_mat.ply", ".ma")


def run(task: Task) -> Details:
    """Read or compute the axis and write it as a skeleton."""
    settings: dict[str, Any] = dict(task.settings["medial_axis"])
    folder = settings.pop("folder")
    settings.pop("surface")
    if folder:
        path = find_medial_axis(Path(folder), Path(task.record.path).stem)
        axis = read_medial_axis(path)
    else:
        mesh = read_mesh(task.read("watertight", ".ply"))
        axis = medial_axis_of_mesh(mesh, np.random.default_rng(task.seed), **settings)
    write_skeleton_ply(task.write(".ply"), axis)
    return {"points": len(axis)}


def find_medial_axis(folder: Path, name: str) -> Path:
    """Return the file of a shape's medial axis, anywhere in `folder`.

    Raises
    ------
    InputError
        If there is none, or more than one.
    """
    found = [path for suffix in SUFFIXES for path in sorted(folder.rglob(f"{name}{suffix}"))]
    if len(found) != 1:
        what = f"{len(found)} files, {found[0]} and others" if found else "no file"
        raise InputError(
            f"{folder}: expected one file {' or '.join(name + suffix for suffix in SUFFIXES)} in it or below, "
            f"found {what}"
        )
    return found[0]
