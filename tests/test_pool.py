import logging
import os
import signal
import time
from pathlib import Path

import psutil
import pytest

from morphoskel.errors import StorageError
from morphoskel.pool import run_isolated


def _act(task):
    action, argument = task
    if action == "raise":
        raise ValueError(argument)
    if action == "refuse":
        raise StorageError(argument)
    if action == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if action == "exit":
        os._exit(3)
    if action == "flaky then refuse":
        marker = Path(argument)
        if marker.exists():
            raise StorageError("full")
        marker.write_text("")
        raise ValueError
    if action == "flaky":
        marker = Path(argument)
        if not marker.exists():
            marker.write_text("")
            os.kill(os.getpid(), signal.SIGKILL)
    return argument


def _outcomes(tasks, workers=2):
    return {outcome.key: outcome for outcome in run_isolated(_act, tasks, workers=workers)}


@pytest.mark.parametrize("workers", [1, 2])
def test_every_task_runs_once(workers):
    outcomes = _outcomes({str(number): ("return", number) for number in range(7)}, workers)
    assert {key: outcome.result for key, outcome in outcomes.items()} == {str(number): number for number in range(7)}
    assert all(outcome.attempts == 1 and outcome.reason == "" for outcome in outcomes.values())


def test_failures_keep_their_reason_and_lose_nobody():
    tasks = {f"good{number}": ("return", number) for number in range(6)}
    tasks = {"bad": ("raise", "no surface"), "crash": ("crash", 0), **tasks, "exit": ("exit", 0)}
    outcomes = _outcomes(tasks)
    assert set(outcomes) == set(tasks)
    assert all(outcomes[f"good{number}"].result == number for number in range(6))
    assert outcomes["bad"].reason == "ValueError: no surface"
    assert "SIGSEGV" in outcomes["crash"].reason
    assert "exit code 3" in outcomes["exit"].reason
    assert all(outcomes[key].attempts == 2 for key in ("bad", "crash", "exit"))


def test_a_task_that_fails_once_is_retried(tmp_path):
    outcome = _outcomes({"flaky": ("flaky", str(tmp_path / "marker"))})["flaky"]
    assert outcome.reason == ""
    assert outcome.attempts == 2


def test_a_crash_leaves_a_traceback_in_the_log(caplog):
    with caplog.at_level(logging.ERROR):
        _outcomes({"wild": ("crash", 0)})
    assert "wild crashed:\nFatal Python error: Segmentation fault" in caplog.text
    assert "in _act" in caplog.text


def test_a_full_disk_ends_it_all_at_the_first_or_second_attempt(tmp_path):
    with pytest.raises(StorageError, match="full"):
        _outcomes({"a": ("return", 0), "b": ("refuse", "full"), "c": ("return", 0)})
    with pytest.raises(StorageError, match="full"):
        _outcomes({"a": ("flaky then refuse", str(tmp_path / "marker"))})


def test_no_tasks_no_outcomes():
    assert _outcomes({}) == {}


def _sleep_under(folder):
    (Path(folder) / str(os.getpid())).write_text("")
    time.sleep(60)


def _run_sleepers(folder):
    list(run_isolated(_sleep_under, {"a": folder, "b": folder}, workers=2))


def test_workers_die_with_a_killed_job(tmp_path):
    """A pool's workers otherwise wait for tasks for ever when the process that owns them is killed."""
    import multiprocessing

    job = multiprocessing.get_context("spawn").Process(target=_run_sleepers, args=(str(tmp_path),))
    job.start()
    deadline = time.monotonic() + 30
    while len(list(tmp_path.iterdir())) < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    workers = [int(entry.name) for entry in tmp_path.iterdir()]
    assert len(workers) == 2
    job.kill()
    job.join()
    while any(psutil.pid_exists(worker) for worker in workers) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(psutil.pid_exists(worker) for worker in workers)
