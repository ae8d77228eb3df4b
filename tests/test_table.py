import math

import pandas as pd
import pytest

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES
from morphoskel.reporting.table import COLUMNS, MEASURED_COLUMNS, assemble, compose_caption, read_table, write_table


def measured(*rows):
    return pd.DataFrame(rows, columns=list(MEASURED_COLUMNS))


def published(*rows):
    return pd.DataFrame(rows, columns=["method", "group", "metric", "value"])


def example():
    """One cell printed and computed, one only printed, two only computed, one failed."""
    return assemble(
        measured(
            ("MS3D", MEAN_OVER_SHAPES, "cd_recon", 0.02, 0.01, 3, 1),
            ("MS3D", "Chair", "cd_recon", 0.0123456789012345, math.nan, 1, 0),
            ("MS3D", "Torus", "cd_recon", math.nan, math.nan, 0, 1),
            ("New", "Chair", "cd_recon", 0.03, math.nan, 1, 0),
        ),
        published(
            ("L1", "Chair", "cd_recon", 0.1126), ("MS3D", "Chair", "cd_recon", 0.0296), ("L1", "Chair", "cd_mat", 0.1)
        ),
        dataset="synthetic",
        seeds=[1, 2],
        protocol="correct",
    )


def test_columns_and_order():
    frame = example()
    assert tuple(frame.columns) == COLUMNS
    assert [tuple(key) for key in frame[["metric", "method", "group"]].to_numpy()] == [
        ("cd_recon", "L1", "Chair"),
        ("cd_recon", "MS3D", "Chair"),
        ("cd_recon", "MS3D", "Torus"),
        ("cd_recon", "MS3D", MEAN_OVER_SHAPES),
        ("cd_recon", "New", "Chair"),
        ("cd_mat", "L1", "Chair"),
    ]
    assert set(frame["seeds"]) == {"1 2"}
    assert set(frame["protocol"]) == {"correct"}


def test_averages_come_last_in_one_order():
    frame = assemble(
        measured(),
        published(*(("L1", group, "oa", 1.0) for group in (MEAN_OVER_SHAPES, "Mug", MEAN_OVER_CATEGORIES))),
        dataset="set",
        seeds=[],
        protocol="correct",
    )
    assert list(frame["group"]) == ["Mug", MEAN_OVER_CATEGORIES, MEAN_OVER_SHAPES]


def test_golden_csv(tmp_path):
    write_table(example(), tmp_path / "table", "Caption.", [])
    assert (tmp_path / "table.csv").read_text() == (
        "dataset,method,group,metric,value,std,paper,n,n_failed,seeds,protocol\n"
        "synthetic,L1,Chair,cd_recon,not run,,0.1126,0,0,1 2,correct\n"
        "synthetic,MS3D,Chair,cd_recon,0.0123456789012345,,0.0296,1,0,1 2,correct\n"
        "synthetic,MS3D,Torus,cd_recon,failed,,,0,1,1 2,correct\n"
        "synthetic,MS3D,Mean over shapes,cd_recon,0.02,0.01,,3,1,1 2,correct\n"
        "synthetic,New,Chair,cd_recon,0.03,,,1,0,1 2,correct\n"
        "synthetic,L1,Chair,cd_mat,not run,,0.1,0,0,1 2,correct\n"
    )


def test_golden_markdown(tmp_path):
    write_table(example(), tmp_path / "table", "Caption.", ["A note."])
    assert (tmp_path / "table.md").read_text(encoding="utf-8") == (
        "Caption.\n"
        "\n"
        "### CD-Recon (lower is better)\n"
        "\n"
        "| Method |  | Chair | Torus | Mean over shapes |\n"
        "| :-- | :-- | --: | --: | --: |\n"
        "| L1 | paper | 0.1126 | – | – |\n"
        "|  | ours | not run | – | – |\n"
        "| MS3D | paper | 0.0296 | – | – |\n"
        "|  | ours | **0.0123** | failed | 0.0200 |\n"
        "|  | difference | -0.0173 | – | – |\n"
        "| New | ours | 0.0300 | – | – |\n"
        "\n"
        "### CD-MAT (lower is better)\n"
        "\n"
        "| Method |  | Chair |\n"
        "| :-- | :-- | --: |\n"
        "| L1 | paper | 0.1000 |\n"
        "|  | ours | not run |\n"
        "\n"
        "1. A note.\n"
    )


def test_files_are_bit_equal_and_nothing_else_is_left(tmp_path):
    for folder in ("first", "second"):
        write_table(example(), tmp_path / folder / "table", "Caption.", ["A note."])
    names = sorted(path.name for path in (tmp_path / "first").iterdir())
    assert names == ["table.csv", "table.md", "table.tex"]
    for name in names:
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "second" / name).read_bytes()


def test_a_stem_may_hold_a_dot(tmp_path):
    write_table(example(), tmp_path / "v1.2", "Caption.", [])
    assert (tmp_path / "v1.2.csv").is_file()


def test_reading_back_gives_the_same_numbers(tmp_path):
    frame = example()
    write_table(frame, tmp_path / "table", "Caption.", [])
    again = read_table(tmp_path / "table.csv")
    pd.testing.assert_frame_equal(again, frame, check_exact=True, check_dtype=False)
    assert math.isnan(again["value"][0])
    assert again["n"].dtype == "int64"


def test_groups_and_seeds_that_look_like_numbers_stay_text(tmp_path):
    frame = assemble(
        measured(("FPS", "8", "oa", 70.0, math.nan, 5, 0)), published(), dataset="set", seeds=[0], protocol="correct"
    )
    write_table(frame, tmp_path / "table", "Caption.", [])
    again = read_table(tmp_path / "table.csv")
    assert (again["group"][0], again["seeds"][0]) == ("8", "0")


def test_nothing_measured_and_nothing_published():
    empty = assemble(measured(), published(), dataset="set", seeds=[], protocol="correct")
    assert tuple(empty.columns) == COLUMNS
    assert len(empty) == 0


def test_captions_name_everything():
    assert compose_caption("Errors", example(), "abc") == (
        "Errors. Data set synthetic; n = 3, n failed = 1 (MS3D); n = 1, n failed = 0 (New); seeds 1 2; "
        "protocol correct; configuration abc."
    )


def test_the_caption_of_a_table_without_results_says_so():
    frame = assemble(measured(), published(("L1", "Mug", "oa", 1.0)), dataset="set", seeds=[], protocol="released")
    assert compose_caption("Errors", frame, "abc").startswith("Errors. Data set set; nothing was run; seeds ")


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (measured(("A", "Mug", "chamfer", 1.0, 0.0, 1, 0)), "no metric 'chamfer'"),
        (measured(*[("A", "Mug", "oa", 1.0, 0.0, 1, 0)] * 2), "measured rows: a second value for A, Mug, oa"),
        (measured().drop(columns="std"), "measured rows: the columns std are missing"),
    ],
)
def test_illegal_rows_are_named(rows, message):
    with pytest.raises(InputError, match=message):
        assemble(rows, published(), dataset="set", seeds=[], protocol="correct")


def test_an_unknown_protocol_is_refused():
    with pytest.raises(InputError, match="protocol"):
        assemble(measured(), published(), dataset="set", seeds=[], protocol="mixed")


def test_a_frame_of_other_columns_is_not_written(tmp_path):
    with pytest.raises(InputError, match="a result table has the columns dataset"):
        write_table(example().drop(columns="seeds"), tmp_path / "table", "Caption.", [])
    assert list(tmp_path.iterdir()) == []


def test_files_that_are_no_result_table_are_refused(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_table(tmp_path / "absent.csv")
    (tmp_path / "other.csv").write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match="expected the columns dataset"):
        read_table(tmp_path / "other.csv")
    (tmp_path / "bad.csv").write_text(",".join(COLUMNS) + "\nset,A,Mug,oa,many,,,1,0,0,correct\n")
    with pytest.raises(InputError, match="a value is not a number"):
        read_table(tmp_path / "bad.csv")
