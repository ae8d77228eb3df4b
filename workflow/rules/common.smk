# What all rules share: the configuration, the axes of the experiment, and the helpers that read them.
import os
import re
from itertools import chain
from pathlib import Path

from morphoskel.config import compose
from morphoskel.config.workflow_path import check_clone_path
from morphoskel.datasets.configured import count_shapes
from morphoskel.provenance import code_digest, content_hash, remember_digests

check_clone_path(Path(workflow.basedir))

# The scripts import the library from this clone, also inside an environment that Snakemake deploys.
os.environ.update(PYTHONPATH=f"{workflow.basedir}/src")

remember_digests(Path(".snakemake/code_digests.json"))

# Relative to the working directory: reports name the inputs of jobs, and shall tell nothing of the machine.
CLONE = Path(os.path.relpath(workflow.basedir))

CONFIG = compose(config.get("overrides", []), Path(workflow.basedir) / "config")
SECTIONS = CONFIG.model_dump(mode="json")

# The data sets by name, and the number of shapes of each split. The second one, if there is one, is for part
# segmentation alone: only the skeletons that this needs are made of it.
DATASETS = {
    chosen["name"]: chosen
    for chosen in (SECTIONS["dataset"], SECTIONS["parts"])
    if chosen
}
ALL_SHAPES = {
    name: count_shapes(chosen, seed=CONFIG.seed) for name, chosen in DATASETS.items()
}
SHAPES = ALL_SHAPES[CONFIG.dataset.name]

# What stands in the place of a surface reconstruction for methods that work on the cloud itself.
CLOUD = "cloud"


pathvars:
    results=f"results/{CONFIG.run}",
    logs=f"results/{CONFIG.run}/logs",
    benchmarks=f"results/{CONFIG.run}/benchmarks",


wildcard_constraints:
    dataset="|".join(map(re.escape, DATASETS)),
    split="|".join(dict.fromkeys(chain.from_iterable(ALL_SHAPES.values()))),
    surface="|".join([*CONFIG.surface.names, CLOUD]),
    skeleton="[a-z0-9_]+",
    shard=r"\d{5}",
    sampler="[a-z0-9_]+",
    ratio=r"\d+",
    seed=r"\d+",
    points=r"\d+",
    candidates=r"\d+",
    shape="overview|torus|box",
    mode="random|grid",
    strategy="[a-z0-9_]+",
    classifier="[a-z0-9_]+",


def section(*keys):
    """Return one section of the configuration as plain values."""
    values = SECTIONS
    for key in keys:
        values = values[key]
    return values


def dataset_section(wildcards):
    """Return the section of the data set that the wildcard names."""
    return DATASETS[wildcards.dataset]


def shape_counts(wildcards):
    """Return the number of shapes of each split of the data set that the wildcard names."""
    return ALL_SHAPES[wildcards.dataset]


def shards(split, dataset=CONFIG.dataset.name):
    """Return the names of the shards of a split; static, from the number of shapes."""
    count = -(-ALL_SHAPES[dataset][split] // CONFIG.shard_size)
    return [f"{number:05d}" for number in range(count)]


def for_parts(usual, wildcards, **names):
    """Return the settings of a stage; for the second data set's shapes, with the values of their own.

    `names` tells which value under `tasks.segmentation.skeletons` takes the place of a setting, unless it is null.
    """
    if wildcards.dataset == CONFIG.dataset.name:
        return usual
    own = section("tasks", "segmentation", "skeletons")
    return {
        name: value if own.get(names.get(name)) is None else own[names[name]]
        for name, value in usual.items()
    }


def reconstruction(wildcards):
    """Return the settings of the surface reconstruction that the wildcards name."""
    return for_parts(section("surface", wildcards.surface), wildcards, depth="depth")


def watertight(wildcards):
    """Return how to close surfaces."""
    return for_parts(section("watertight"), wildcards, resolution="resolution")


def candidates(wildcards):
    """Return how to scatter candidates."""
    return for_parts(section("skeleton", "candidates"), wildcards, count="candidates")


def intermediate(folder):
    """Mark a folder that only later stages read; kept or not, as the configuration says."""
    return directory(folder) if CONFIG.keep_intermediates else temp(directory(folder))


# All cores that the run may use. On a cluster there is no such number, and inside its jobs it is that of the node:
# there, as many as a job of the chain has.
ALL_CORES = (
    None if workflow.remote_exec else workflow.resource_settings.cores
) or CONFIG.cores

# MB for a job of the chain whose workers each hold the inner points of one shape. The first summand holds Snakemake,
# which runs twice around a job of a cluster (140 MB each), and the job's main process.
MEMORY_OF_A_SHAPE = 400 + CONFIG.skeleton.candidates.count * 60 // 1_000_000
MEMORY = 1000 + CONFIG.cores * MEMORY_OF_A_SHAPE

# An upper bound on its minutes: one a shape and one more every 10 million candidates, where seconds were measured.
MINUTES_OF_A_SHAPE = 1 + CONFIG.skeleton.candidates.count // 10_000_000
WORKERS = max(CONFIG.cores // CONFIG.threads, 1)
MINUTES = 10 + CONFIG.shard_size * MINUTES_OF_A_SHAPE // WORKERS


def rising(amount):
    """Return a resource that grows with every attempt: a job that was killed for want of memory or time gets more."""
    return lambda wildcards, attempt: attempt * amount


# Written out where params need them, in which Snakemake does not replace <results>.
RESULTS = f"results/{CONFIG.run}"
SKELETONS = (
    f"{RESULTS}/skeletons/{{dataset}}/{{split}}/{{surface}}/{{skeleton}}/{{shard}}"
)
AXES = f"{RESULTS}/medial_axis/{{dataset}}/{{split}}/{{shard}}"
EVALUATION = f"{RESULTS}/evaluation/{{dataset}}/{{split}}/{{surface}}/{{skeleton}}.csv"

# Of the trainings for parts, and of what they wait for: the training with all labels is the longest job of all, and
# would run alone in the end if it came last.
EARLY = 10

# Of a training. It does not rise with the attempts: a training that was stopped goes on where it was.
TRAINING_MINUTES = 2880

# What a training asks for beside processors.
TRAINING_DEVICES = (
    {"gpu": CONFIG.trainer.devices} if CONFIG.trainer.accelerator == "gpu" else {}
)
TRAINER = {
    name: value for name, value in section("trainer").items() if name != "together"
}

# How logs and benchmarks of one training, or of all those of a job, are called.
TRAINING = "all" if CONFIG.trainer.together else "{ratio}/{seed}"


def of_one_job(pattern, **axes):
    """Return the networks that one job trains: all those along the axes, or the one that wildcards name."""
    together = CONFIG.trainer.together
    return expand(pattern, **axes, allow_missing=True) if together else [pattern]


def dataset_source(wildcards):
    """Return the folder of the data set, if there is one; else the manifest job says what to fetch.

    A folder that a rule makes is made anew when its code or settings change, and the manifest after it. A folder of
    the user's is looked at for its number of shapes only: its time changes with every file put beside them.
    """
    chosen = dataset_section(wildcards)
    if chosen["kind"] == "synthetic":
        return [chosen["root"]]
    if Path(chosen["root"]).exists() or chosen.get("url"):
        return [ancient(chosen["root"])]
    return []


def provenance():
    """Return what a table's caption has to tell of its origin."""
    return {
        "dataset": CONFIG.dataset.name,
        "protocol": CONFIG.protocol,
        "seed": CONFIG.seed,
        "candidates": f"{CONFIG.skeleton.candidates.count:,} {CONFIG.skeleton.candidates.mode}",
        "medial_axis": "given" if CONFIG.medial_axis.folder else "computed",
        "config": content_hash(SECTIONS),
    }
