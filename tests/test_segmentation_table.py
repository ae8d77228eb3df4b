import math
import statistics

import numpy as np
import pytest
from conftest import REPOSITORY
from segmented import segmentation_frame, segmentation_rows

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES
from morphoskel.reporting.segmentation_footnotes import PUBLISHED_SHAPES
from morphoskel.reporting.segmentation_table import build_segmentation_table
from morphoskel.reporting.table import COLUMNS, write_table

FOLDER = REPOSITORY / "config" / "paper"
CATEGORIES = list(PUBLISHED_SHAPES)


def build(*parts, **more):
    frame = segmentation_frame(*parts)
    return build_segmentation_table(frame, FOLDER, dataset="mine", protocol="correct", **more)


def find(result, method, group=MEAN_OVER_SHAPES, metric="miou"):
    frame = result.frame
    found = frame[(frame["method"] == method) & (frame["group"] == group) & (frame["metric"] == metric)]
    return found.iloc[0] if len(found) else None


def everywhere(strategy, value=0.5, **more):
    """One shape of each of the paper's categories."""
    return [row for name in CATEGORIES for row in segmentation_rows(strategy, [value], category=name, **more)]


def test_every_printed_cell_appears_and_is_not_run(tmp_path):
    result = build()
    assert tuple(result.frame.columns) == COLUMNS
    means = result.frame[result.frame["metric"] == "miou"]
    assert len(means) == 9 * (16 + 2)
    assert means["paper"].notna().sum() == 9 * 17
    assert find(result, "FPS, ratio 16")["paper"] == 80.1
    assert find(result, "MS3D minus FPS, ratio 128", metric="miou_difference")["paper"] == pytest.approx(3.2)
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    assert (tmp_path / "table.csv").read_text().count(",not run,") == 9 * 18 + 4
    assert (
        "| FPS, ratio 64 | paper | – | 77.3 |\n|  | ours | not run | not run |" in (tmp_path / "table.md").read_text()
    )


def test_the_papers_mean_over_categories_stays_empty():
    result = build(everywhere("fps"))
    cell = find(result, "FPS, ratio 16", MEAN_OVER_CATEGORIES)
    assert cell["value"] == 50.0
    assert math.isnan(cell["paper"])
    assert math.isnan(find(result, "MS3D, ratio 16", MEAN_OVER_CATEGORIES)["value"])


def test_values_agree_with_loops():
    values = np.random.default_rng(0).random((3, 12))
    categories = ["Chair"] * 7 + ["Lamp"] * 2 + ["Mug"] * 3
    parts = []
    for seed, of_training in enumerate(values):
        for name in ("Chair", "Lamp", "Mug"):
            chosen = [value for value, category in zip(of_training, categories, strict=True) if category == name]
            parts.append(segmentation_rows("ms3d", chosen, "64", seed, name, labels=20.0 + seed**2))
    result = build(*parts[::-1])

    def means_of(name):
        """One mean a training, by loops."""
        means = []
        for of_training in values:
            chosen = [value for value, category in zip(of_training, categories, strict=True) if category in name]
            means.append(100 * sum(chosen) / len(chosen))
        return means

    groups = {name: means_of([name]) for name in ("Chair", "Lamp", "Mug")}
    groups[MEAN_OVER_CATEGORIES] = [sum(means) / 3 for means in zip(*groups.values(), strict=True)]
    groups[MEAN_OVER_SHAPES] = means_of(["Chair", "Lamp", "Mug"])
    for group, means in groups.items():
        cell = find(result, "MS3D, ratio 64", group)
        assert cell["value"] == pytest.approx(sum(means) / 3)
        assert cell["std"] == pytest.approx(statistics.stdev(means))
        assert (cell["n"], cell["n_failed"]) == ({"Chair": 7, "Lamp": 2, "Mug": 3}.get(group, 12), 0)
        assert cell["seeds"] == "0 1 2"
    half = find(result, "MS3D, ratio 64", metric="miou_interval")["value"]
    assert half == pytest.approx(100 * 1.96 * values.mean(axis=0).std() / math.sqrt(12), rel=0.15)
    labels = find(result, "MS3D, ratio 64", metric="labels")
    assert (labels["value"], labels["n"]) == (pytest.approx((20 + 21 + 24) / 3), 3)
    assert labels["std"] == pytest.approx(statistics.stdev([20, 21, 24]))


def test_differences_are_paired_and_at_the_same_ratio():
    rng = np.random.default_rng(1)
    ease = rng.random(20) / 2
    parts = [
        segmentation_rows(strategy, ease + gain + 0.01 * rng.random(20), ratio, seed)
        for strategy, gain in (("ms3d", 0.2), ("fps", 0.1), ("uniform", 0.2), ("lfs", 0.05))
        for ratio in ("16", "32")
        for seed in (0, 1)
        if (strategy, ratio) != ("uniform", "32")
    ]
    result = build(*parts)
    for ratio in ("16", "32"):
        means = {name: find(result, f"{name}, ratio {ratio}")["value"] for name in ("MS3D", "FPS", "LFS-weighted FPS")}
        for first, second in (("MS3D", "FPS"), ("LFS-weighted FPS", "FPS")):
            row = f"{first} minus {second}, ratio {ratio}"
            value, low, high = (
                find(result, row, metric=f"miou_difference{end}")["value"] for end in ("", "_low", "_high")
            )
            assert value == pytest.approx(means[first] - means[second])
            assert low < value < high
            assert high - low < find(result, f"FPS, ratio {ratio}", metric="miou_interval")["value"] / 5
    uniform = find(result, "MS3D minus uniform prior, ratio 16", metric="miou_difference")
    assert uniform["value"] == pytest.approx(0, abs=1)
    assert find(result, "MS3D minus uniform prior, ratio 32", metric="miou_difference") is None
    assert find(result, "MS3D minus Random, ratio 16", metric="miou_difference") is None


def test_failed_shapes_are_left_out_and_counted():
    result = build(segmentation_rows("fps", [0.5, math.nan]), segmentation_rows("fps", [math.nan], category="Mug"))
    cell = find(result, "FPS, ratio 16")
    assert (cell["value"], cell["n"], cell["n_failed"]) == (50.0, 1, 2)
    assert math.isnan(find(result, "FPS, ratio 16", "Mug")["value"])
    assert math.isnan(find(result, "FPS, ratio 16", MEAN_OVER_CATEGORIES)["value"])
    assert find(result, "FPS, ratio 16", metric="miou_interval") is None


def test_rows_are_in_one_order_whatever_that_of_the_files():
    parts = [everywhere(strategy, ratio=ratio) for strategy in ("uniform", "ms3d", "lfs") for ratio in ("128", "16")]
    parts.append(everywhere("full", ratio="1", labels=100.0))
    result = build(*parts)
    means = result.frame[result.frame["metric"] == "miou"]
    methods = list(dict.fromkeys(means["method"]))
    assert methods[:5] == [
        "PointNet (all labels)", "FPS, ratio 16", "LFS-weighted FPS, ratio 16", "MS3D, ratio 16",
        "uniform prior, ratio 16",
    ]  # fmt: skip
    assert next(name for name in methods if "128" in name) == "FPS, ratio 128"
    of_first = list(means.loc[means["method"] == methods[0], "group"])
    assert of_first == [*CATEGORIES, MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES]
    assert build(*parts[::-1]).frame.equals(result.frame)


def test_the_best_is_that_of_one_ratio(tmp_path):
    values = {("fps", "16"): 0.9, ("ms3d", "16"): 0.8, ("fps", "32"): 0.3, ("ms3d", "32"): 0.4, ("full", "1"): 0.95}
    result = build(*(everywhere(strategy, value, ratio=ratio) for (strategy, ratio), value in values.items()))
    write_table(result.frame, tmp_path / "table", "Caption.", result.footnotes)
    lines = (tmp_path / "table.md").read_text().split("###")[1].splitlines()
    assert [line for line in lines if "**" in line] == [
        "|  | ours | **90.0** | **90.0 ± 0.0** |",
        "|  | ours | **40.0** | **40.0 ± 0.0** |",
    ]


def test_the_papers_means_go_where_the_categories_are_others():
    result = build(segmentation_rows("fps", [0.5], category="Torus"))
    assert math.isnan(find(result, "FPS, ratio 16")["paper"])
    assert math.isnan(find(result, "MS3D minus FPS, ratio 16", metric="miou_difference")["paper"])
    assert find(result, "FPS, ratio 16", "Chair")["paper"] == 88.0
    assert any("averages are over Airplane, Bag" in note for note in result.footnotes)


def test_illegal_rows_are_refused():
    with pytest.raises(InputError, match="unknown strategy"):
        build(segmentation_rows("pointnet", [0.5]))
