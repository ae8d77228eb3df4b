import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import psutil
import pytest

from morphoskel.datasets.modelnet40 import ModelNet40Dataset
from tests.load.check import check_memory, growth
from tests.load.clouds import COUNTS, split_counts, superellipsoid, write_clouds
from tests.load.processes import snapshot, survivors
from tests.load.record import BEGIN, END, by_minute, write_page
from tests.load.run import INTERRUPTS, Load


def test_the_full_test_has_the_splits_of_modelnet40():
    assert split_counts(sum(COUNTS.values())) == COUNTS


def test_clouds_are_read_as_modelnet40(tmp_path):
    write_clouds(tmp_path / "clouds", 6)
    dataset = ModelNet40Dataset(tmp_path / "clouds")
    assert dataset.counts() == {"train": 5, "test": 1}
    cloud = dataset.load(dataset.list_shapes()[-1].path)
    assert cloud.normals is not None
    assert np.allclose(np.linalg.norm(cloud.normals, axis=1), 1, atol=1e-5)


def test_normals_point_outward():
    rows = superellipsoid(np.random.default_rng(3))
    assert (np.einsum("ij,ij->i", rows[:, :3], rows[:, 3:]) > 0).all()


def test_growth_is_found_under_noise_and_peaks():
    shapes, noise = np.linspace(0, 5000, 400), np.random.default_rng(0).normal(0, 2, 400)
    noise[::40] += 300
    assert growth(shapes, 180 + noise, 1000) == pytest.approx(0, abs=0.3)
    assert growth(shapes, 180 + 0.01 * shapes + noise, 1000) == pytest.approx(10, abs=0.3)


def test_growth_while_warming_up_does_not_count():
    shapes = np.arange(1000.0)
    assert growth(shapes, np.minimum(shapes, 200), 100) == 0


def test_a_short_series_says_nothing():
    assert growth(np.arange(10.0), np.arange(10.0), 1) is None
    assert growth(np.arange(100.0), np.arange(100.0), 1000) is None


def looks(between=0.0, within=0.0):
    """Return the looks at a main process and at ten workers, which grow from one to the next, or each in its life."""
    rows = [
        row
        for second in range(200)
        for row in (
            (second, 1, second, "snakemake", "", 1, 150.0),
            (
                second,
                1,
                second,
                "worker",
                "udf",
                2 + second // 20,
                100 + between * (second // 20) + within * (second % 20),
            ),
        )
    ]
    return pd.DataFrame(rows, columns=["seconds", "attempt", "jobs", "role", "stage", "pid", "megabytes"])


@pytest.mark.parametrize(
    ("grows", "missed"),
    [
        ({}, set()),
        ({"between": 10.0}, {"largest worker, udf"}),
        ({"within": 1.0}, {"worker in its life, udf"}),
    ],
)
def test_workers_must_neither_grow_from_job_to_job_nor_in_their_life(grows, missed):
    rows = check_memory(looks(**grows), Load(Path("load"), shapes=8000, shard_size=200))
    assert [row["series"] for row in rows] == [
        "main process, attempt 1",
        "largest worker, udf",
        "worker in its life, udf",
    ]
    assert {row["series"] for row in rows if row["mb_in_1000_shapes"] > row["bound"]} == missed


def test_minutes_keep_the_largest_memory():
    minutes = by_minute(looks(within=1.0))
    workers = minutes[minutes["role"] == "worker"]
    assert workers["largest_mb"].tolist() == [119, 119, 119, 119]


def test_the_page_is_written_between_its_marks(tmp_path):
    page = tmp_path / "load.md"
    page.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
    attempt = {"attempt": 1, "ended": "finished", "exit_code": 0, "seconds": 600.0, "jobs": 6, "seconds_to_end": 0.0,
               "survivors": 0}  # fmt: skip
    summary = {"date": "2025-03-25T00:00:00", "commit": None, "machine": {"cores": 2, "processor": "Fast One"},
               "shapes": 10, "shard_size": 8, "jobs": 6, "states": {"complete": 10}, "attempts": [attempt],
               "memory": check_memory(looks(), Load(tmp_path, 10, 8)), "missed": []}  # fmt: skip
    pd.Series(summary).to_json(tmp_path / "summary.json")
    write_page(tmp_path, page)
    text = page.read_text()
    assert text.startswith("before\n")
    assert text.endswith("after\n")
    assert "old" not in text
    assert "10 shapes in 6 jobs of up to 8 shapes took 10 minutes on 2 cores (Fast One)" in text
    write_page(tmp_path, page)
    assert page.read_text() == text


def test_processes_are_known_by_what_they_do(tmp_path):
    script = tmp_path / "run_stage.py"
    script.write_text("import time; time.sleep(60)")
    parent = "import subprocess, sys; subprocess.run([sys.executable, sys.argv[1]])"
    run = subprocess.Popen([sys.executable, "-c", parent, str(script)], start_new_session=True)
    process = psutil.Process(run.pid)
    try:
        while not (rows := snapshot(process)):
            assert run.poll() is None
        [(role, stage, pid, megabytes)] = rows
        assert (role, stage) == ("job", "")
        assert megabytes > 0
        job = psutil.Process(pid)
        assert survivors([job], 0.1) == [job]
    finally:
        for child in process.children(recursive=True):
            child.kill()
        run.kill()
        run.wait()
    assert survivors([job], 10) == []


def test_interrupts_leave_most_of_the_run_undisturbed(tmp_path):
    shares = [share for share, _ in INTERRUPTS]
    assert shares == sorted(shares)
    assert shares[-1] <= 0.25
    assert Load(tmp_path, 12_311, 256).jobs == 6 * (39 + 10)
