"""The same chain as the workflow's, called in one process: a pool of workers, each taking a shape from start to end."""

import sys
import time
from dataclasses import dataclass
from pathlib import Path

from morphoskel.config import Config, compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import read_manifest
from morphoskel.formats import write_skeleton_ply
from morphoskel.pool import run_isolated
from morphoskel.skeletonization import skeletonize_shape

PRELOAD = ("morphoskel.chain.compiler", "open3d", "point_cloud_utils", "morphoskel.skeletonization")


@dataclass(frozen=True)
class Shape:
    """What a worker needs to know."""

    config: Config
    id: str
    path: str
    output: Path


def skeletonize(shape: Shape) -> None:
    """Run all stages on one shape and write its skeleton."""
    config = shape.config
    dataset = open_configured(config.dataset.model_dump(mode="json"), seed=config.seed)
    result = skeletonize_shape(
        dataset.load(shape.path),
        reconstruction=config.surface.poisson.model_dump(),
        watertight_settings=config.watertight.model_dump(),
        candidates=config.skeleton.candidates.model_dump(),
        k=config.skeleton.k,
        points=config.skeleton.points,
        seed=config.seed,
        name=shape.id,
        threads=config.threads,
    )
    write_skeleton_ply(shape.output / f"{shape.id}.ply", result.skeleton)


def main(arguments: list[str]) -> None:
    """Skeletonize the test split of a manifest and print the seconds."""
    manifest, output, *overrides = arguments
    start = time.perf_counter()
    config = compose(overrides)
    records = read_manifest(Path(manifest), split="test")
    shapes = {record.id: Shape(config, record.id, record.path, Path(output)) for record in records}
    outcomes = list(run_isolated(skeletonize, shapes, workers=config.cores, preload=PRELOAD))
    failed = [f"{outcome.key}: {outcome.reason}" for outcome in outcomes if outcome.reason]
    if failed:
        sys.exit("\n".join(failed))
    sys.stdout.write(f"{time.perf_counter() - start:.3f}\n")
