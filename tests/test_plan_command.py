import json

import pytest
from conftest import REPOSITORY
from measured_run import write_measured_run

from morphoskel.cli import main


@pytest.mark.workflow
@pytest.mark.timeout(1800)
def test_the_published_protocol_is_planned_without_its_data(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(REPOSITORY)
    run = write_measured_run(tmp_path / "small")
    words = [
        "skeletons",
        "experiment=paper",
        "surface=[poisson,ponq]",
        "skeleton=[ms3d]",
        "medial_axis.surface=poisson",
    ]
    words += ["shard_size=2048", f"dataset.root={tmp_path}/absent"]
    assert main(["plan", *words, "--measured", str(run), "--at-once", "2", "--json"]) == 0
    plan = json.loads(capsys.readouterr().out)
    rows = {(row["rule"], row["kind"]): row for row in plan["rows"]}
    assert rows["reconstruct", "poisson"]["jobs"] == 3 + 1  # 5904 and 1184 shapes in shards of 2048
    assert rows["reconstruct", "poisson"]["amount"] == 5904 + 1184
    assert rows["reconstruct", "poisson"]["core_hours_held"] == pytest.approx(7088 * 2 / 3600)  # 2 core-seconds a shape
    assert not rows["reconstruct", "ponq"]["measured"]
    assert rows["udf", ""]["amount"] == 2 * 7088 * 10_000_000
    assert plan["totals"]["bytes_removed"] > 0
    assert [wall["at_once"] for wall in plan["wall_hours"]] == [2]


def test_measurements_outlive_their_run(tmp_path, monkeypatch):
    monkeypatch.chdir(REPOSITORY)
    run = write_measured_run(tmp_path / "small")
    assert main(["plan", "--measured", str(run), "--save", str(tmp_path / "times.csv")]) == 0
    assert (tmp_path / "times.csv").read_text().count("small") == 3


def test_a_run_that_is_none_is_told(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(REPOSITORY)
    assert main(["plan", "--measured", str(tmp_path)]) == 1
    assert "name the folder of a finished run" in capsys.readouterr().err
    assert main(["plan", "--measured", str(tmp_path), "--at-once", "0"]) == 1
    assert "must be at least 1" in capsys.readouterr().err
