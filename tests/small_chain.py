"""The per-shape chain on a few small clouds, run without Snakemake: shared by the tests of shards and of faults."""

import hashlib

import numpy as np
from solids import sphere_cloud

from morphoskel.chain.shard import run_shard
from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.formats import write_cloud_ply
from morphoskel.shapes import PointCloud
from morphoskel.stages import STAGES

READS = {
    "watertight": ["reconstruct"],
    "occupancy": ["watertight"],
    "udf": ["watertight", "occupancy"],
    "dilation": ["occupancy", "udf"],
    "select_skeleton": ["occupancy", "udf", "dilation"],
}
SEED = 11


def write_clouds(root, count):
    """Write spheres that are stretched more and more."""
    for number in range(count):
        cloud = sphere_cloud(400, seed=number)
        stretched = cloud.points * np.array([1, 1 + 0.2 * number, 0.5])
        write_cloud_ply(root / f"shape{number}.ply", PointCloud(stretched, cloud.normals))


def small_sections(root):
    """Return a configuration under which every stage takes a moment."""
    overrides = ["experiment=smoke", "dataset=folder", f"dataset.root={root}", "skeleton.candidates.count=5000"]
    return compose(
        [*overrides, "skeleton.points=64", "surface.poisson.depth=5", "watertight.resolution=1000"]
    ).model_dump(mode="json")


def settings_of(stage, sections):
    """Return the settings that the workflow gives to a stage."""
    skeleton = sections["skeleton"]
    return {
        "reconstruct": {
            "dataset": sections["dataset"],
            "dataset_seed": SEED,
            "surface": "poisson",
            "reconstruction": sections["surface"]["poisson"],
        },
        "watertight": {"watertight": sections["watertight"]},
        "dilation": {"candidates": skeleton["candidates"], "k": skeleton["k"]},
        "select_skeleton": {"candidates": skeleton["candidates"], "points": skeleton["points"]},
    }.get(stage, {"candidates": skeleton["candidates"]})


def list_clouds(folder, sections, shard_size):
    """Write the manifest and return its records."""
    records = build_manifest(open_configured(sections["dataset"], seed=SEED).list_shapes(), shard_size=shard_size)
    write_manifest(folder / "manifest.csv", records)
    return records


def run_stage(folder, sections, stage, *, shard=0, workers=2, threads=1):
    """Run one stage on a shard of the one split there is."""
    return run_shard(
        stage,
        manifest=folder / "manifest.csv",
        split="test",
        shard=shard,
        inputs={earlier: folder / earlier / str(shard) for earlier in READS.get(stage, [])},
        output=folder / stage / str(shard),
        settings=settings_of(stage, sections),
        seed=SEED,
        cores=workers,
        threads=threads,
        log=f"logs/{stage}/{shard}.log",
    )


def run_chain(folder, sections, shard_size, workers, threads=1):
    """Run all stages on all shards, and return the digests of the skeletons."""
    for shard in sorted({record.shard for record in list_clouds(folder, sections, shard_size)}):
        for stage in STAGES:
            run_stage(folder, sections, stage, shard=shard, workers=workers, threads=threads)
    return skeletons(folder)


def skeletons(folder):
    """Return the digest of every skeleton by the name of its file."""
    found = sorted((folder / "select_skeleton").glob("*/*.ply"))
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in found}
