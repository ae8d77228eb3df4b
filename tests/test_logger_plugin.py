"""The plugin by itself, and in a small workflow that Snakemake runs."""

import logging
import os
import subprocess
import sys

import pytest
from conftest import REPOSITORY
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.tests import MockOutputSettings, TestLogHandlerBase

from snakemake_logger_plugin_morphoskel import COMMAND, LogHandler

WORKFLOW = """
rule all:
    input:
        expand("results/r/tables/{name}.{kind}", name=["a", "b"], kind=["csv", "md"]),
        "results/r/bad/1.txt",


rule table:
    output:
        "results/r/tables/{name}.csv",
        "results/r/tables/{name}.md",
    shell:
        "touch {output}"


rule bad:
    output:
        "results/r/bad/{x}.txt",
    log:
        "results/r/logs/bad_{x}.log",
    shell:
        "echo there is no surface > {log}; test -e mended; touch {output}"
"""


class TestOfTheInterface(TestLogHandlerBase):
    """What the interface package asks of every plugin."""

    __test__ = True

    def get_log_handler_cls(self):
        return LogHandler

    def get_log_handler_settings(self):
        return None


def handler(**settings):
    common = MockOutputSettings()
    for name, value in settings.items():
        setattr(common, name, value)
    return LogHandler(common, None)


def record(event, message="", level=logging.INFO, **values):
    made = logging.LogRecord("snakemake", level, __file__, 1, message, (), None)
    made.__dict__.update(values, **({"event": event} if event else {}))
    return made


def job(number):
    return {"jobid": number, "rule_name": "udf", "wildcards": {"shard": f"{number:05d}"}, "output": [], "log": []}


def play(plugin):
    """Tell of a run of two jobs, the first of which ends."""
    plugin.emit(record(LogEvent.RUN_INFO, "Job stats:", stats={"udf": 2, "total": 2}))
    plugin.emit(record(None, "Select jobs to execute..."))
    plugin.emit(record(LogEvent.JOB_STARTED, "Execute 1 jobs...", jobs=[1]))
    plugin.emit(record(LogEvent.JOB_INFO, **job(1)))
    plugin.emit(record(LogEvent.JOB_FINISHED, "Finished jobid: 1", job_id=1))
    plugin.emit(record(LogEvent.PROGRESS, done=1, total=2))


def test_a_job_has_a_line_at_its_start_and_end(capsys):
    play(handler())
    lines = capsys.readouterr().err.splitlines()
    assert lines[:2] == ["Job stats:", "[0/2] started udf (00001)"]
    assert lines[2].startswith("[1/2] 50 % · 0.0 s")
    assert lines[2].endswith("udf (00001) took 0.0 s")
    assert len(lines) == 3


def test_warnings_and_unknown_messages_stay(capsys):
    plugin = handler()
    play(plugin)
    plugin.emit(record(None, "this file is old", logging.WARNING))
    plugin.emit(record(LogEvent.SHELLCMD, shellcmd="touch a", cmd="touch a"))
    assert capsys.readouterr().err.splitlines()[3:] == ["this file is old", "touch a"]


def test_an_error_of_the_plugin_hands_over_to_snakemake(capsys):
    plugin = handler()
    play(plugin)
    plugin.emit(record(LogEvent.JOB_INFO, jobid=2))  # lacks all else
    plugin.emit(record(None, "the run goes on"))
    plugin.emit(record(LogEvent.PROGRESS, done=2, total=2))
    plugin.close()
    shown = capsys.readouterr().err
    assert "the display of progress failed (KeyError" in shown
    assert shown.endswith("the run goes on\n2 of 2 steps (100%) done\n")


def test_a_closed_stream_breaks_nothing(monkeypatch, tmp_path):
    stream = (tmp_path / "screen").open("w")
    monkeypatch.setattr(sys, "stderr", stream)
    plugin = handler()
    stream.close()
    play(plugin)
    plugin.close()


def test_quiet_means_quiet(capsys):
    from snakemake.settings.enums import Quietness

    plugin = handler(quiet={Quietness.ALL})
    play(plugin)
    plugin.close()
    assert capsys.readouterr().err == ""


def test_a_stream_that_lacks_a_character_gets_another(monkeypatch, tmp_path):
    with (tmp_path / "screen").open("w", encoding="ascii") as stream:
        monkeypatch.setattr(sys, "stderr", stream)
        play(handler())
    assert "[1/2] 50 % - 0.0 s" in (tmp_path / "screen").read_text()


def test_the_end_is_told_once_and_names_the_command(capsys, monkeypatch):
    monkeypatch.setenv(COMMAND, "morphoskel run seed=7")
    plugin = handler()
    play(plugin)
    plugin.close()
    plugin.close()
    assert capsys.readouterr().err.count("`morphoskel run seed=7` goes on where this run stopped") == 1


def snakemake(folder, *options):
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY / "src")}
    environment.pop(COMMAND, None)
    command = [sys.executable, "-m", "snakemake", "--cores", "1", "--logger", "morphoskel", "--keep-going", *options]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.workflow
def test_a_run_that_fails_and_goes_on(tmp_path):
    (tmp_path / "Snakefile").write_text(WORKFLOW)
    code, shown = snakemake(tmp_path, "--show-failed-logs")
    assert code == 1
    assert "[0/4] started " in shown
    assert "Error in rule bad:" in shown
    assert "there is no surface" in shown
    assert shown.endswith(
        "\n"
        "table   results/r/tables/a.{csv,md}\n"
        "table   results/r/tables/b.{csv,md}\n"
        "2 of 4 jobs are done, 1 failed:\n"
        "  bad (1): results/r/logs/bad_1.log\n"
        "The same command goes on where this run stopped; what is finished is kept.\n"
    )
    (log,) = (tmp_path / ".snakemake" / "log").iterdir()
    assert "Finished jobid: " in log.read_text()
    assert "2 of 4 steps (50%) done" in log.read_text()

    code, shown = snakemake(tmp_path, "--dry-run")
    assert code == 0
    assert "rule bad:" in shown
    assert "started" not in shown

    (tmp_path / "mended").touch()
    code, shown = snakemake(tmp_path)
    assert code == 0
    assert "[2/2] 100 %" in shown
    assert "goes on" not in shown
