from morphoskel.run_progress.job_lines import JobLines
from morphoskel.run_progress.outcome import Job

UDF = Job("udf", ("test", "00000"), ("results/demo/udf/test/00000",), ("results/demo/logs/udf.log",))


def test_lines_count_and_estimate(tmp_path):
    lines = JobLines({"udf": 100}, 50.0, tmp_path)
    assert lines.start(7, UDF, 50.0) == "[  0/100] started udf (test, 00000)"
    expected = "[  1/100] 1 % · 14 s · about 23 min left · udf (test, 00000) took 14 s"
    assert lines.finish(7, 64.0) == expected


def test_no_estimate_while_too_little_is_known_or_nothing_is_left(tmp_path):
    lines = JobLines({"config": 1, "udf": 3}, 0.0, tmp_path)
    lines.start(0, Job("config"), 0.0)
    assert lines.finish(0, 1.0) == "[1/4] 25 % · 1 s · config took 1 s"
    for number in (1, 2, 3):
        lines.start(number, UDF, 1.0)
    lines.finish(1, 3.0)
    assert lines.is_running(2)
    lines.finish(2, 3.0)
    assert not lines.is_running(2)
    assert lines.finish(3, 3.0) == "[4/4] 100 % · 3 s · udf (test, 00000) took 2 s"


def test_earlier_runs_are_asked_as_soon_as_the_run_is_known(tmp_path):
    file = tmp_path / "demo" / "benchmarks" / "udf.tsv"
    file.parent.mkdir(parents=True)
    file.write_text("s\n60.0\n")
    lines = JobLines({"config": 1, "udf": 2}, 0.0, tmp_path)
    lines.start(0, Job("config", outputs=("results/demo/config.yaml",)), 0.0)
    assert "about 2 min left" in lines.finish(0, 0.5)


def test_the_end_of_a_failed_run(tmp_path):
    lines = JobLines({"udf": 2}, 0.0, tmp_path)
    lines.start(1, UDF, 0.0)
    assert lines.fail(1, 5.0) == "[0/2] FAILED udf (test, 00000) after 5 s"
    assert lines.end("morphoskel run")[:2] == ["0 of 2 jobs are done, 1 failed:", f"  {UDF}: results/demo/logs/udf.log"]


def test_another_attempt_makes_up_for_a_failure(tmp_path):
    lines = JobLines({"udf": 1}, 0.0, tmp_path)
    lines.start(1, UDF, 0.0)
    lines.fail(1, 5.0)
    lines.start(1, UDF, 6.0)
    lines.finish(1, 8.0)
    assert lines.end() == []
