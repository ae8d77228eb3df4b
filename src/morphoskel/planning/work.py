"""What the cost of each rule is proportional to, and which settings it depends on otherwise.

A rule that is not listed here is counted, but no time is ever claimed for it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from morphoskel.planning.extent import Extent
from morphoskel.sampling.samplers import GENERATORS, TRAINING_FREE

Wildcards = Mapping[str, str]
Amount = Callable[[Extent, Wildcards], float]

SIZES = frozenset(
    {"points", "skeletal_points", "centroids", "neighbours", "channels", "head_channels", "node_features",
     "graph_channels", "neighbourhood", "hops", "k", "global_features", "head", "weight_channels", "point_channels",
     "before", "after", "cloud_features", "point_transform_channels", "point_transform_head",
     "feature_transform_channels", "feature_transform_head", "drop_style", "batch_size"}
)  # fmt: skip
"""Settings of a network that decide what a step costs; the others decide what it learns."""


@dataclass(frozen=True)
class Work:
    """One rule.

    Parameters
    ----------
    layout
        Its benchmark files, below the folder ``benchmarks`` of a run.
    unit
        What the time is proportional to, in words.
    amount
        The same as a number, of one job.
    settings
        Dotted paths, with wildcards in braces, of the settings that must agree for a measurement to count.
    networks
        The same of networks, of which the sizes must agree.
    by
        The wildcard whose values are measured apart from each other.
    threads
        The setting that holds the number of cores of a job; empty for one core.
    output
        The file or folder that a job writes, below the run's folder, if its size is to be estimated.
    intermediate
        Whether that is removed after use, unless ``keep_intermediates`` is set, and grows like the time does. All
        other outputs grow with the shapes.
    """

    layout: str
    unit: str
    amount: Amount
    settings: tuple[str, ...] = ()
    networks: tuple[str, ...] = ()
    by: str = ""
    threads: str = ""
    output: str = ""
    intermediate: bool = False


def fingerprint(work: Work, extent: Extent, wildcards: Wildcards) -> str:
    """Return the settings that must agree between a planned and a measured job, as text."""
    values = {path: extent.setting(path, wildcards) for path in (each.format(**wildcards) for each in work.settings)}
    for pattern in work.networks:
        path = _network_path(pattern, wildcards)
        sizes = extent.setting(path, wildcards) or {}
        values[path] = {key: value for key, value in sizes.items() if key in SIZES}
    return json.dumps(values, sort_keys=True, default=str)


def _network_path(pattern: str, wildcards: Wildcards) -> str:
    if pattern == "{network of the sampler}":
        sampler = wildcards["sampler"]
        if sampler in TRAINING_FREE:
            return ""
        return f"samplers.{sampler}" if sampler in GENERATORS else "sampling.network"
    return pattern.format(**wildcards)


def _shapes(extent: Extent, wildcards: Wildcards) -> float:
    return extent.shapes(wildcards)


def _candidates(extent: Extent, wildcards: Wildcards) -> float:
    return extent.shapes(wildcards) * float(extent.setting("skeleton.candidates.count", wildcards))


def _points(extent: Extent, wildcards: Wildcards) -> float:
    return extent.shapes(wildcards) * float(wildcards["points"])


def _choices(extent: Extent, wildcards: Wildcards) -> float:
    sampling = extent.config["sampling"]
    return extent.shapes(wildcards) * float(sampling["points"] * len(sampling["ratios"]) * sampling["draws"])


def _learned(extent: Extent, share: str) -> float:
    """Return the number of shapes that a training learns from."""
    return extent.shapes({}, "train") * (1 - float(extent.setting(share, {})))


def _point2skeleton(extent: Extent, wildcards: Wildcards) -> float:
    network = extent.setting("methods.point2skeleton.network", {})
    epochs = sum(network[f"{phase}_epochs"] for phase in ("pretrain", "skeleton", "link"))
    return float(epochs) * _learned(extent, "methods.point2skeleton.validation_share")


def _classifier(extent: Extent, wildcards: Wildcards) -> float:
    kind = "plain" if wildcards["classifier"] == "plain" else "classifier"
    epochs = float(extent.setting(f"tasks.classification.{kind}.epochs", {}))
    return epochs * _learned(extent, "sampling.validation_share") * float(extent.config["sampling"]["points"])


def _skeleton_aware(extent: Extent, wildcards: Wildcards) -> float:
    network = extent.setting("samplers.skeleton_aware.skeleton", {})
    epochs = float(network["pretrain_epochs"] + network["skeleton_epochs"])
    return epochs * _learned(extent, "sampling.validation_share") * float(extent.config["sampling"]["points"])


def _sampler(extent: Extent, wildcards: Wildcards) -> float:
    sampling = extent.config["sampling"]
    network = extent.setting(_network_path("{network of the sampler}", wildcards), {})
    shown = (
        sampling["steps"] * network["batch_size"]
        if sampling["steps"]
        else network["epochs"] * _learned(extent, "sampling.validation_share")
    )
    trainings = 1 if "ratio" in wildcards else len(sampling["ratios"]) * sampling["seeds"]
    return float(shown * trainings * sampling["points"])


CHAIN = "{dataset}/{split}/{surface}/{shard}"
ON_CLOUD = "{dataset}/{split}/{shard}"
CANDIDATES = ("skeleton.candidates.mode",)

WORK: dict[str, Work] = {
    "reconstruct": Work(CHAIN, "shapes", _shapes, ("surface.{surface}",), by="surface", threads="cores",
                        output=f"surfaces/{CHAIN}"),
    "watertight": Work(CHAIN, "shapes", _shapes, ("watertight.resolution",), threads="cores",
                       output=f"watertight/{CHAIN}"),
    "occupancy": Work(CHAIN, "shapes x candidates", _candidates, CANDIDATES, threads="cores",
                      output=f"occupancy/{CHAIN}", intermediate=True),
    "udf": Work(CHAIN, "shapes x candidates", _candidates, CANDIDATES, threads="cores", output=f"udf/{CHAIN}",
                intermediate=True),
    "dilation": Work(CHAIN, "shapes x candidates", _candidates, (*CANDIDATES, "skeleton.k"), threads="cores",
                     output=f"dilation/{CHAIN}", intermediate=True),
    "select_skeleton": Work(CHAIN, "shapes x candidates", _candidates, (*CANDIDATES, "skeleton.points"),
                            threads="cores", output="skeletons/{dataset}/{split}/{surface}/ms3d/{shard}"),
    "cover_skeleton": Work(CHAIN, "shapes x candidates", _candidates,
                           (*CANDIDATES, "skeleton.points", "skeleton.coverage"), threads="cores",
                           output="skeletons/{dataset}/{split}/{surface}/ms3d_coverage/{shard}"),
    "medial_axis": Work(ON_CLOUD, "shapes", _shapes,
                        tuple(f"medial_axis.{key}" for key in ("samples", "tolerance", "gap", "count")),
                        threads="cores", output=f"medial_axis/{ON_CLOUD}"),
    "coverage_axis": Work(CHAIN, "shapes", _shapes, ("methods.coverage_axis",), threads="cores",
                          output="skeletons/{dataset}/{split}/{surface}/coverage_axis/{shard}"),
    "l1_medial": Work(ON_CLOUD, "shapes", _shapes, ("methods.l1_medial",), threads="cores",
                      output="skeletons/{dataset}/{split}/cloud/l1_medial/{shard}"),
    "dpc": Work(ON_CLOUD, "shapes", _shapes, ("methods.dpc",), threads="cores",
                output="skeletons/{dataset}/{split}/cloud/dpc/{shard}"),
    "point2skeleton": Work(ON_CLOUD, "shapes", _shapes, networks=("methods.point2skeleton.network",), threads="cores",
                           output="skeletons/{dataset}/{split}/cloud/point2skeleton/{shard}"),
    "evaluate_skeletons": Work("{dataset}/{split}/{surface}/{skeleton}", "shapes", _shapes,
                               ("evaluation.equal_counts", "methods.point2skeleton.dense_balls"), by="skeleton",
                               output="evaluation/{dataset}/{split}/{surface}/{skeleton}.csv"),
    "gather_clouds": Work("{dataset}/{split}/{points}", "shapes x points", _points,
                          output="clouds/{dataset}/{split}/{points}.npz"),
    "local_feature_size": Work("{dataset}/{split}/{points}/{skeleton}", "shapes x points", _points,
                               output="priors/{dataset}/{split}/{points}/{skeleton}.npz"),
    "choose_points": Work("{dataset}/{split}/{sampler}", "shapes x points x ratios x draws", _choices,
                          networks=("{network of the sampler}",), by="sampler", threads="trainer.threads",
                          output="samples/{dataset}/{split}/{sampler}"),
    "evaluate_samples": Work("{dataset}/{split}/{sampler}", "shapes x points x ratios x draws", _choices,
                             by="sampler", threads="trainer.threads"),
    "train_point2skeleton": Work("", "shapes x epochs", _point2skeleton, networks=("methods.point2skeleton.network",),
                                 threads="trainer.threads"),
    "train_classifier": Work("{dataset}/{classifier}", "shapes x epochs x points", _classifier,
                             networks=("tasks.classification.classifier",), threads="trainer.threads"),
    "train_skeleton_aware": Work("", "shapes x epochs x points", _skeleton_aware,
                                 networks=("samplers.skeleton_aware.skeleton",), threads="trainer.threads"),
    "train_sampler": Work("{dataset}/{sampler}", "clouds shown x points", _sampler,
                          networks=("{network of the sampler}",), by="sampler", threads="trainer.threads"),
    "illustrate": Work("{shape}_{mode}_{candidates}", "candidates", lambda extent, wildcards:
                       float(wildcards["candidates"]), by="shape", threads="cores"),
}  # fmt: skip
"""By rule."""
