"""Shapes of a run to turn on the page: one a category, with its cloud, surface, balls, residues and chosen points."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from morphoskel.chain.inner import read_inner_points
from morphoskel.chain.status import read_status
from morphoskel.chain.task import Task
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import ShapeRecord, first_of_each_category, read_manifest
from morphoskel.errors import InputError
from morphoskel.formats import read_skeleton_ply
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.morphology.residue import residue
from morphoskel.progress import track
from morphoskel.reporting.page.chosen_layers import chosen_layers
from morphoskel.reporting.scene import Layer, Scalar, Scene
from morphoskel.reporting.scene_encoding import encode_scenes
from morphoskel.reporting.scene_layers import cloud_layer, mesh_layer, skeleton_layers

logger = logging.getLogger(__name__)

MOST_SHAPES = 8
MOST_BYTES = 5_000_000
"""Of all shapes as the page holds them."""

TRIANGLES = 20_000
INNER_POINTS = 20_000
"""What a page holds of one shape."""

RESIDUE_QUANTILE = 0.95
"""A few residues far above the others, near the surface, would leave one colour to the rest."""

INNER_LABEL = "residue of an inner point, in the shape's unit"
"""On a scale of its own: a skeleton has the least residues of all."""

STAGES = ("occupancy", "udf", "dilation")
"""Stages whose files tell the residue of every inner point."""

AZIMUTH, ELEVATION = 215.0, 18.0
"""The published clouds have y up and face negative z."""


@dataclass(frozen=True)
class SceneSources:
    """Files that the shapes are read from.

    Parameters
    ----------
    manifest, split
        Which shapes there are.
    dataset, seed
        The configuration's data set section and the global seed.
    watertight, skeletons
        Folders of all shards: closed surfaces, and the skeletons found in them.
    method
        What the skeletons are called, with their surface.
    inner
        Folders of all shards for each stage in :data:`STAGES`; without them no inner points are shown.
    candidates
        How the inner points were scattered: the settings that the stages had.
    clouds
        File of the clouds that points were chosen from.
    samples
        For each sampler, by its name for readers, the folder of its choices. The first is visible at first.
    ratio
        Points of a cloud for each point chosen.
    """

    manifest: Path
    split: str
    dataset: Mapping[str, Any]
    seed: int
    watertight: Sequence[Path]
    skeletons: Sequence[Path]
    method: str = "MS3D"
    inner: Mapping[str, Sequence[Path]] = field(default_factory=dict)
    candidates: Mapping[str, Any] | None = None
    clouds: Path | None = None
    samples: Mapping[str, Path] = field(default_factory=dict)
    ratio: int = 8


def run_scenes(sources: SceneSources) -> list[Scene]:
    """Return a scene for the first shape of each category that has a skeleton, of at most :data:`MOST_SHAPES`.

    Where there are more categories, they are taken evenly. As many scenes are returned as fit in :data:`MOST_BYTES`.

    Raises
    ------
    InputError
        If a file is absent or damaged, or no shape has a skeleton.
    DatasetError
        If the manifest is absent, or has no shape of the split.
    """
    homes = _homes(sources.skeletons)
    records = [record for record in read_manifest(sources.manifest, split=sources.split) if record.id in homes]
    if not records:
        raise InputError(f"{sources.split}: no shape has a skeleton, so there is nothing to show; see status.csv")
    first = first_of_each_category(records)
    step = -(-len(first) // MOST_SHAPES)
    scenes: list[Scene] = []
    used = 0
    for record in track(first[::step], "shapes of the page"):
        scene = Scene(record.category, _layers(sources, record, homes), azimuth=AZIMUTH, elevation=ELEVATION)
        size = len(encode_scenes([scene]))
        if scenes and used + size > MOST_BYTES:
            logger.warning("%s and what follows is left out: the page holds %d bytes of shapes", record.id, MOST_BYTES)
            break
        scenes.append(scene)
        used += size
    return scenes


def _homes(folders: Sequence[Path]) -> dict[str, Path]:
    """Return the folder that holds the file of each shape that did not fail."""
    return {row.id: folder for folder in folders for row in read_status(folder) if row.status == "ok"}


def _layers(sources: SceneSources, record: ShapeRecord, homes: Mapping[str, Path]) -> list[Layer]:
    """Return the layers of a shape in the order in which they are made."""
    cloud = cloud_layer(open_configured(sources.dataset, seed=sources.seed).load(record.path), "cloud", visible=False)
    surface = read_mesh(_homes(sources.watertight)[record.id] / f"{record.id}.ply")
    layers = [
        replace(cloud, detail=f"{record.id}, {cloud.detail}"),
        mesh_layer(surface, "closed surface", triangles=TRIANGLES),
    ]
    if sources.inner and sources.candidates is not None:
        layers.append(_inner_layer(sources, record))
    skeleton = read_skeleton_ply(homes[record.id] / f"{record.id}.ply")
    layers += skeleton_layers(skeleton, f"balls of {sources.method}")
    if sources.clouds is not None:
        layers += chosen_layers(record.id, sources.clouds, sources.samples, sources.ratio)
    return layers


def _inner_layer(sources: SceneSources, record: ShapeRecord) -> Layer:
    """Return the inner points, coloured by residue; of many every second, third, and so on, as they are in order."""
    folders = {stage: _homes(sources.inner[stage])[record.id] for stage in STAGES}
    task = Task(record, folders, folders["occupancy"], {"candidates": sources.candidates}, seed=0)
    points = read_inner_points(task)
    residues = residue(
        np.load(task.read("udf", ".npy"), allow_pickle=False),
        np.load(task.read("dilation", ".npy"), allow_pickle=False),
    ).astype(np.float64)
    step = -(-len(points) // INNER_POINTS)
    scalar = Scalar(INNER_LABEL, residues[::step], (0.0, float(np.quantile(residues, RESIDUE_QUANTILE))))
    return Layer(
        "inner points, by residue", "points", points[::step].astype(np.float64), scalars=(scalar,), visible=False,
        size=0.8, detail=f"{len(scalar.values):,} of {len(points):,} points",
    )  # fmt: skip
