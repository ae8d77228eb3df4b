"""Layers of the interactive viewer that show which points each sampler chose."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.errors import InputError
from morphoskel.reporting.scene import Layer
from morphoskel.sampling.choice import DRAWN, FIXED, read_choice

CHOSEN_SIZE = 2.0
"""Of chosen points, relative to a size that suits a cloud of their number."""


def chosen_layers(shape: str, clouds: Path, samples: Mapping[str, Path], ratio: int) -> list[Layer]:
    """Return one layer a sampler with the points that it chose of a shape, in the shape's own unit.

    Parameters
    ----------
    shape
        Id of the shape.
    clouds
        File of the clouds that points were chosen from.
    samples
        For each sampler, by its name for readers, the folder of its choices; the first is visible at first. Of a
        sampler with noise the first draw of its first training is shown.
    ratio
        Points of a cloud for each point chosen.

    Raises
    ------
    InputError
        If a file is absent or damaged, or no points were chosen at that ratio.
    """
    shapes = read_cloud_set(clouds)
    places = np.flatnonzero(shapes.ids == shape)
    if not len(places):
        return []
    place = int(places[0])
    cloud = shapes.points[place].astype(np.float64) * shapes.scales[place] + shapes.centres[place]
    layers: list[Layer] = []
    for name, folder in samples.items():
        paths = [folder / f"{ratio}_0_{kind}.npz" for kind in (DRAWN, FIXED)]
        path = next((path for path in paths if path.is_file()), None)
        if path is None:
            known = ", ".join(sorted(path.name for path in folder.glob("*.npz"))) or "nothing"
            raise InputError(f"{folder}: expected {paths[0].name} or {paths[1].name}, found {known}; choose the points")
        indices = read_choice(path).indices[0, place]
        if (indices < 0).any():  # nothing could be chosen of this shape
            continue
        distinct = np.unique(indices)
        layers.append(
            Layer(f"points of {name}", "points", cloud[distinct], tone="strong", size=CHOSEN_SIZE, visible=not layers,
                  detail=f"{len(distinct):,} of {len(cloud):,} points")
        )  # fmt: skip
    return layers
