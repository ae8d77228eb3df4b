import pandas as pd
import pytest
from conftest import REPOSITORY
from segmented import segmentation_frame, segmentation_rows

from morphoskel.errors import InputError
from morphoskel.reporting.segmentation_table_files import TITLE, write_segmentation_table

PUBLISHED = REPOSITORY / "config" / "paper"
PROVENANCE = {"dataset": "mine", "seed": 7, "seeds": 2, "budget": "4 epochs a training", "protocol": "correct",
              "config": "abc123", "decisions": ["Labels are chosen once."], "transferred_from": "others"}  # fmt: skip


def write_results(folder):
    """Write the CSV files of two strategies and return their paths."""
    paths = []
    for strategy in ("fps", "ms3d"):
        parts = [segmentation_rows(strategy, [1.0, 0.4], seed=seed) for seed in (0, 1)]
        paths.append(folder / f"{strategy}.csv")
        segmentation_frame(*parts).to_csv(paths[-1], index=False)
    return paths


def write(paths, stem):
    write_segmentation_table(paths, PUBLISHED, stem, PROVENANCE)


def test_the_table_holds_the_computed_and_the_published_values(tmp_path):
    write(write_results(tmp_path), tmp_path / "table")
    frame = pd.read_csv(tmp_path / "table.csv", keep_default_na=False, dtype=str)
    row = frame[(frame["method"] == "MS3D, ratio 16") & (frame["metric"] == "miou") & (frame["group"] == "Chair")]
    assert row[["value", "paper", "n", "seeds"]].iloc[0].tolist() == ["70.0", "85.3", "2", "0 1"]
    text = (tmp_path / "table.md").read_text(encoding="utf-8")
    facts = (TITLE, "trainings of each row: 2, 4 epochs a training", "Data set mine", "n = 2, n failed = 0;", "seeds 7",
             "protocol correct", "abc123")  # fmt: skip
    for words in facts:
        assert words in text.splitlines()[0]
    assert "Labels are chosen once." in text
    assert "trained on others" in text


def test_wide_tables_stay_within_a_page(tmp_path):
    write(write_results(tmp_path), tmp_path / "table")
    text = (tmp_path / "table.md").read_text(encoding="utf-8")
    assert max(line.count("|") for line in text.splitlines()) == 2 + 8 + 1
    headings = [line for line in text.splitlines() if line.startswith("### Mean")]
    assert [heading.partition(": ")[2] for heading in headings] == [
        "averages, ± half-width of the 95 % interval over shapes", "Airplane to Knife", "Lamp to Table"
    ]  # fmt: skip
    latex = (tmp_path / "table.tex").read_text(encoding="utf-8")
    assert latex.count(r"\begin{table*}") == latex.count(r"\end{table*}") > 1
    assert latex.count(r"\caption") == 1


def test_equal_results_make_equal_bytes_whatever_the_order_of_files(tmp_path):
    paths = write_results(tmp_path)
    write(paths, tmp_path / "first")
    write(paths[::-1], tmp_path / "second")
    for suffix in ("csv", "md", "tex"):
        assert (tmp_path / f"first.{suffix}").read_bytes() == (tmp_path / f"second.{suffix}").read_bytes()


def test_without_files_nothing_was_run(tmp_path):
    write([], tmp_path / "table")
    text = (tmp_path / "table.md").read_text(encoding="utf-8")
    assert "nothing was run" in text
    assert "| PointNet (all labels) | paper | – | 83.7 |\n|  | ours | not run | not run |" in text


def test_bad_files_are_named(tmp_path):
    with pytest.raises(InputError, match=r"absent\.csv: no such file"):
        write([tmp_path / "absent.csv"], tmp_path / "table")
    segmentation_frame(segmentation_rows("fps", [0.5], iou=2.0)).to_csv(tmp_path / "bad.csv", index=False)
    with pytest.raises(InputError, match=r"shape a .*iou is not in \[0, 1\]"):
        write([tmp_path / "bad.csv"], tmp_path / "table")
    assert not list(tmp_path.glob("table*"))
