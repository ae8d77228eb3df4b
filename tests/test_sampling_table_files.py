import math

import pandas as pd
import pytest
from conftest import REPOSITORY
from sampled import draw_frame, draw_rows, shape_frame, shape_rows

from morphoskel.errors import InputError
from morphoskel.reporting.sampling_table_files import TITLES, write_sampling_table

PUBLISHED = REPOSITORY / "config" / "paper"
PROVENANCE = {"dataset": "mine", "seed": 7, "seeds": 2, "draws": 3, "budget": "4 steps a training",
              "protocol": "correct", "config": "abc123"}  # fmt: skip
RESULTS = {
    "random": [shape_rows("random", [1.0, 0.4])],
    "ms3d": [
        shape_rows("ms3d", [1.0, math.nan], seed=seed, choice=choice)
        for seed in (0, 1)
        for choice in ("drawn", "argmax")
    ],
}


def write_results(folder):
    """Write the CSV files of two samplers and return their paths."""
    shapes, draws = [], []
    for sampler, parts in RESULTS.items():
        shapes.append(folder / f"{sampler}.csv")
        shape_frame(*parts).to_csv(shapes[-1], index=False)
        draws.append(folder / f"{sampler}_draws.csv")
        draw_frame(draw_rows(sampler, [0.5, 1.0])).to_csv(draws[-1], index=False)
    return shapes, draws


@pytest.mark.parametrize("name", TITLES)
def test_tables_hold_the_computed_and_the_published_values(name, tmp_path):
    write_sampling_table(name, *write_results(tmp_path), PUBLISHED, tmp_path / "table", PROVENANCE)
    frame = pd.read_csv(tmp_path / "table.csv", keep_default_na=False, dtype=str)
    metric = "map" if name == "point_cloud_retrieval" else "oa"
    row = frame[(frame["method"] == "MS3D") & (frame["metric"] == metric) & (frame["group"] == "8")].iloc[0]
    assert float(row["value"]) == 100.0
    assert float(row["paper"]) > 70
    assert (row["n"], row["n_failed"], row["seeds"]) == ("1", "1", "0 1")
    caption = (tmp_path / "table.md").read_text(encoding="utf-8").splitlines()[0]
    counts = "n = 2, n failed = 0 (Random); n = 1, n failed = 1 (MS3D)"
    facts = ("draws: 3", "sampler: 2, 4 steps a training", "Data set mine", "seeds 7", "protocol correct", "abc123")
    for words in (TITLES[name], counts, *facts):
        assert words in caption
    assert (tmp_path / "table.tex").is_file()


def test_equal_results_make_equal_bytes_whatever_the_order_of_files(tmp_path):
    shapes, draws = write_results(tmp_path)
    write_sampling_table("skeleton_prior", shapes, draws, PUBLISHED, tmp_path / "first", PROVENANCE)
    write_sampling_table("skeleton_prior", shapes[::-1], draws[::-1], PUBLISHED, tmp_path / "second", PROVENANCE)
    for suffix in ("csv", "md", "tex"):
        assert (tmp_path / f"first.{suffix}").read_bytes() == (tmp_path / f"second.{suffix}").read_bytes()


def test_without_files_nothing_was_run(tmp_path):
    write_sampling_table("object_classification", [], [], PUBLISHED, tmp_path / "table", PROVENANCE)
    assert "nothing was run" in (tmp_path / "table.md").read_text(encoding="utf-8")


def test_names_that_look_like_missing_numbers_stay_names(tmp_path):
    shape_frame(shape_rows("fps", [1.0], choice="fixed", id="nan", category="None")).to_csv(
        tmp_path / "fps.csv", index=False
    )
    write_sampling_table("object_classification", [tmp_path / "fps.csv"], [], PUBLISHED, tmp_path / "table", PROVENANCE)
    assert "n = 1, n failed = 0" in (tmp_path / "table.md").read_text(encoding="utf-8")


def test_bad_files_are_named(tmp_path):
    def write(*paths):
        write_sampling_table("object_classification", paths, [], PUBLISHED, tmp_path / "table", PROVENANCE)

    with pytest.raises(InputError, match=r"absent\.csv: no such file"):
        write(tmp_path / "absent.csv")
    path = tmp_path / "bad.csv"
    shape_frame(shape_rows("fps", [1.0])).drop(columns="distinct").to_csv(path, index=False)
    with pytest.raises(InputError, match=r"bad\.csv: the columns distinct are missing"):
        write(path)
    shape_frame(shape_rows("fps", [1.0], correct="yes")).to_csv(path, index=False)
    with pytest.raises(InputError, match=r"bad\.csv: a value is not a number"):
        write(path)
    with pytest.raises(InputError, match="legal are object_classification"):
        write_sampling_table("nothing", [], [], PUBLISHED, tmp_path / "table", PROVENANCE)
    assert not list(tmp_path.glob("table*"))
