# What all rules share: the configuration, the axes of the experiment, and the helpers that read them.
import os
from pathlib import Path

from morphoskel.config import compose
from morphoskel.datasets.configured import count_shapes
from morphoskel.provenance import code_digest, content_hash, remember_digests

# The scripts import the library from this clone, also inside an environment that Snakemake deploys.
os.environ.update(PYTHONPATH=f"{workflow.basedir}/src")

remember_digests(Path(".snakemake/code_digests.json"))

CONFIG = compose(config.get("overrides", []), Path(workflow.basedir) / "config")
SECTIONS = CONFIG.model_dump(mode="json")
SHAPES = count_shapes(SECTIONS["dataset"], seed=CONFIG.seed)


pathvars:
    results=f"results/{CONFIG.run}",
    logs=f"results/{CONFIG.run}/logs",
    benchmarks=f"results/{CONFIG.run}/benchmarks",


wildcard_constraints:
    dataset=CONFIG.dataset.name,
    split="|".join(SHAPES),
    surface="|".join(CONFIG.surface.names),
    shard=r"\d{5}",


def section(*keys):
    """Return one section of the configuration as plain values."""
    values = SECTIONS
    for key in keys:
        values = values[key]
    return values


def shards(split):
    """Return the names of the shards of a split; static, from the number of shapes."""
    count = -(-SHAPES[split] // CONFIG.shard_size)
    return [f"{number:05d}" for number in range(count)]


def reconstruction(wildcards):
    """Return the settings of the surface reconstruction that the wildcard names."""
    return section("surface", wildcards.surface)


def intermediate(folder):
    """Mark a folder that only later stages read; kept or not, as the configuration says."""
    return directory(folder) if CONFIG.keep_intermediates else temp(directory(folder))


# MB for a job of the chain whose workers each hold the inner points of one shape, and an upper bound on its minutes.
# Plain numbers: a function would be called anew for every job of a dry run.
MEMORY = 600 + CONFIG.cores * (400 + CONFIG.skeleton.candidates.count * 60 // 1_000_000)
MINUTES = 10 + CONFIG.shard_size * (1 + CONFIG.skeleton.candidates.count // 10_000_000)


def skeleton_shards(wildcards):
    """Return the skeleton folders of one split and surface."""
    return expand(
        rules.select_skeleton.output[0],
        shard=shards(wildcards.split),
        allow_missing=True,
    )


def evaluated_shards(pattern, surface):
    """Return the folders of the evaluated split under one surface reconstruction."""
    return expand(
        pattern,
        dataset=CONFIG.dataset.name,
        split=CONFIG.evaluation.split,
        surface=surface,
        shard=shards(CONFIG.evaluation.split),
    )


def all_skeletons(pattern):
    """Return the folders of every split and surface reconstruction."""
    return [
        folder
        for split in SHAPES
        for folder in expand(
            pattern,
            dataset=CONFIG.dataset.name,
            split=split,
            surface=CONFIG.surface.names,
            shard=shards(split),
        )
    ]


def dataset_source(wildcards):
    """Return the folder of the data set, if there is one; else the manifest job says what to fetch.

    A folder that a rule makes is made anew when its code or settings change, and the manifest after it. A folder of
    the user's is looked at for its number of shapes only: its time changes with every file put beside them.
    """
    root = section("dataset", "root")
    if CONFIG.dataset.kind == "synthetic":
        return [root]
    if CONFIG.dataset.root.exists() or getattr(CONFIG.dataset, "url", None):
        return [ancient(root)]
    return []


def of_every_surface(kind):
    """Return the result files of the evaluated split, one for each surface reconstruction."""
    return expand(
        "<results>/{kind}/{dataset}/{split}/{surface}.csv",
        kind=kind,
        dataset=CONFIG.dataset.name,
        split=CONFIG.evaluation.split,
        surface=CONFIG.surface.names,
    )


def provenance():
    """Return what a table's caption has to tell of its origin."""
    return {
        "dataset": CONFIG.dataset.name,
        "protocol": CONFIG.protocol,
        "seed": CONFIG.seed,
        "candidates": f"{CONFIG.skeleton.candidates.count:,} {CONFIG.skeleton.candidates.mode}",
        "config": content_hash(SECTIONS),
    }
