"""Every reader of files in the project, and whole files to begin with."""

from __future__ import annotations

import contextlib
import importlib
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fuzz import shape_seeds as shapes
from fuzz import text_seeds as texts
from morphoskel.errors import MorphoSkelError


def _just_read(function: Callable[..., Any], path: Path) -> object:
    return function(path)


@dataclass(frozen=True)
class Reader:
    """A reader under test.

    Parameters
    ----------
    function
        ``module:name`` of what is tested.
    file
        Name of the file, below a folder of its own.
    seeds
        Returns whole files; may write others beside them that the reader needs.
    call
        Calls the function, given it and the path.
    named
        Whether errors must name the file: not those of a configuration, which comes from the command line.
    """

    function: str
    file: str
    seeds: Callable[[Path], list[bytes]]
    call: Callable[[Callable[..., Any], Path], object] = _just_read
    named: bool = True

    def read(self, path: Path) -> object:
        """Read the file."""
        module, _, name = self.function.partition(":")
        try:
            return self.call(getattr(importlib.import_module(f"morphoskel.{module}"), name), path)
        except MorphoSkelError as error:
            if not self.named:
                raise type(error)(f"{path.name}: {error}") from error
            raise

    def warm_up(self, path: Path, contents: Sequence[bytes]) -> None:
        """Read whole files, so that what is imported and compiled on the way is not counted as theirs."""
        for content in contents:
            path.write_bytes(content)
            with warnings.catch_warnings(), contextlib.suppress(MorphoSkelError):
                warnings.simplefilter("ignore")
                self.read(path)


def _shape(suffix: str, contents: Callable[[Path], list[bytes]]) -> Reader:
    return Reader("formats.read:read_shape", f"shape{suffix}", contents)


def _network(function: str, name: str) -> Reader:
    def contents(folder: Path) -> list[bytes]:
        from fuzz import network_seeds  # torch takes seconds to import

        found: list[bytes] = getattr(network_seeds, name)(folder)
        return found

    return Reader(f"networks.{function}", "network.pt", contents)


READERS: dict[str, Reader] = {
    "ply": _shape(".ply", shapes.ply_files),
    "pcd": _shape(".pcd", shapes.pcd_files),
    "obj": _shape(".obj", shapes.obj_files),
    "off": _shape(".off", shapes.off_files),
    "stl": _shape(".stl", shapes.stl_files),
    "text": _shape(".txt", shapes.text_files),
    "npy": _shape(".npy", shapes.npy_files),
    "npz": _shape(".npz", shapes.npz_files),
    "skeleton_ply": Reader("formats.skeleton_file:read_skeleton_or_shape", "curve.ply", shapes.skeleton_ply_files),
    "skeleton_npz": Reader("formats.skeleton_file:read_skeleton_or_shape", "curve.npz", shapes.skeleton_npz_files),
    "medial_axis_ma": Reader("formats.medial_axis_file:read_medial_axis", "axis.ma", shapes.medial_axis_files),
    "medial_axis_ply": Reader("formats.medial_axis_file:read_medial_axis", "axis.ply", shapes.skeleton_ply_files),
    "chosen_points": Reader(
        "reporting.scene_files:scenes_of_files",
        "chosen.npz",
        shapes.chosen_points_files,
        lambda read, path: read([path]),
    ),
    "illustration": Reader("reporting.illustration_file:read_illustration", "ball.npz", shapes.illustration_files),
    "cloud_set": Reader("datasets.cloud_set:read_cloud_set", "test.npz", shapes.cloud_set_files),
    "prior_set": Reader(
        "sampling.prior_set:read_prior_set",
        "priors.npz",
        shapes.prior_set_files,
        lambda read, path: read(path, shapes.small_cloud_set()),
    ),
    "choice": Reader("sampling.choice:read_choice", "8_0_drawn.npz", shapes.choice_files),
    "manifest": Reader("datasets.manifest:read_manifest", "manifest.csv", texts.manifest_files),
    "status": Reader(
        "chain.status:read_status", "status.csv", texts.status_files, lambda read, path: read(path.parent)
    ),
    "split_list": Reader("datasets.dataset:read_lines", "all-test.txt", texts.split_lists),
    "shapenetpart_list": Reader(
        "datasets.shapenetpart:ShapeNetPartDataset",
        "train_test_split/shuffled_test_file_list.json",
        texts.shapenetpart_lists,
        lambda dataset, path: dataset(path.parents[1], allow_missing=True).list_shapes(),
    ),
    "shapenetpart_labels": Reader(
        "datasets.shapenetpart:ShapeNetPartDataset",
        "03467517/points_label/shape.seg",
        texts.label_files,
        lambda dataset, path: dataset(path.parents[2]).load(path.parents[1] / "points" / "shape.pts"),
    ),
    "synthetic_description": Reader(
        "datasets.synthetic.dataset:SyntheticDataset",
        "synthetic.json",
        texts.synthetic_descriptions,
        lambda dataset, path: texts.synthetic_dataset(dataset, path.parent).list_shapes(),
    ),
    "archive": Reader("datasets.extract:extract", "archive.zip", texts.archives, texts.extract_anew),
    "published_table": Reader(
        "reporting.published:read_published",
        "processing_time.csv",
        texts.published_tables,
        lambda read, path: read(path.parent, path.stem),
    ),
    "result_table": Reader("reporting.table:read_table", "table.csv", texts.result_tables),
    "result_rows": Reader(
        "reporting.result_rows:read_result_rows",
        "fps.csv",
        texts.result_rows,
        lambda read, path: read([path], texts.RESULT_COLUMNS),
    ),
    "stage_times": Reader(
        "reporting.figures.stage_times_files:read_times",
        "times.csv",
        texts.stage_times,
        lambda read, path: read([path]),
    ),
    "scaling": Reader("evaluation.scaling:read_scaling", "scaling.csv", texts.scaling_files),
    "benchmark": Reader(
        "reporting.page.stage_times:sum_benchmarks",
        "rule.tsv",
        texts.benchmarks,
        lambda read, path: read(path.parent),
    ),
    "provenance": Reader("run_provenance:read_provenance", "provenance.json", texts.provenance_files),
    "run_configuration": Reader(
        "reporting.page.configuration:read_configuration", "config.yaml", texts.short_config_files
    ),
    "network_classifier": _network("pointnet_classifier:load_classifier", "classifier_files"),
    "network_generator": _network("point_generator:load_generator", "generator_files"),
    "network_sampler": _network("skeleton_sampler:load_skeleton_sampler", "sampler_files"),
    "network_skeleton": _network("skeleton_aware_network:load_skeleton_aware", "skeleton_aware_files"),
    "network_segmentation": _network("part_segmentation:load_segmentation", "segmentation_files"),
    "network_point2skeleton": _network("point2skeleton_network:load_point2skeleton", "point2skeleton_files"),
    "overrides": Reader(
        "config.explain:check_overrides", "overrides", texts.override_files, texts.check_overrides, named=False
    ),
    "configuration": Reader("config.compose:compose", "overrides", texts.override_files, texts.compose, named=False),
    "configuration_values": Reader(
        "config.compose:validate", "config.yaml", texts.config_files, texts.validate, named=False
    ),
}
"""By name; a name is also what decides an input's randomness."""
