import math

import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.page.stage_times import StageTime, sum_benchmarks

HEADER = "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"


def write(path, seconds, memory="100.5", processor="1.5"):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"{HEADER}{seconds}\t0:00:21\t{memory}\t1\t1\t1\t0\t0\t50\t{processor}\n")


def test_jobs_are_summed_by_rule_whatever_the_depth(tmp_path):
    write(tmp_path / "udf/synthetic/test/poisson/00000.tsv", 2.25)
    write(tmp_path / "udf/synthetic/test/ponq/00000.tsv", 4.0, memory="300", processor="0.5")
    write(tmp_path / "train.tsv", 10)
    assert sum_benchmarks(tmp_path) == [
        StageTime("train", 1, 10.0, 10.0, 1.5, 100.5),
        StageTime("udf", 2, 6.25, 4.0, 2.0, 300.0),
    ]


@pytest.mark.parametrize("nothing", ["NA", "-", ""])
def test_what_was_not_measured_does_not_count(tmp_path, nothing):
    write(tmp_path / "short/a.tsv", 0.1, nothing, nothing)
    [time] = sum_benchmarks(tmp_path)
    assert math.isnan(time.memory)
    assert math.isnan(time.cpu_seconds)
    write(tmp_path / "short/b.tsv", 0.1)
    [time] = sum_benchmarks(tmp_path)
    assert (time.memory, time.cpu_seconds) == (100.5, 1.5)


def test_a_run_without_benchmarks_has_no_times(tmp_path):
    assert sum_benchmarks(tmp_path / "absent") == []


@pytest.mark.parametrize(
    "text", ["", "a\tb\n1\t2\n", HEADER, f"{HEADER}soon{'	1' * 9}\n", f"{HEADER}NA{'	1' * 9}\n"]
)
def test_other_files_are_refused(tmp_path, text):
    (tmp_path / "a.tsv").write_text(text)
    with pytest.raises(InputError, match=r"a\.tsv: expected a benchmark"):
        sum_benchmarks(tmp_path)
