import os
import signal
import subprocess
import sys
import time

import pytest
import yaml
from conftest import REPOSITORY

from morphoskel.errors import MorphoSkelError
from morphoskel.workflow_run import find_repository, release_stale_lock, snakemake_command, typed_command


def test_overrides_reach_snakemake_as_one_list():
    command = snakemake_command(["table_processing_time"], ["skeleton.k=30", "surface=[poisson]"], [])
    assert command[:4] == [sys.executable, "-m", "snakemake", "table_processing_time"]
    assert command[-2:] == ["--config", 'overrides=["skeleton.k=30", "surface=[poisson]"]']


@pytest.mark.parametrize("name", ["it's", 'say "hi"', "Möbel 椅子 😀", "$(touch evil)", "{split}", "a: b", "tab\tstop"])
def test_snakemake_reads_every_override_as_it_was_written(name):
    """Snakemake reads the list as YAML."""
    overrides = [f"dataset.root={name}", "seed=7"]
    assert yaml.safe_load(snakemake_command([], overrides, [])[-1].removeprefix("overrides=")) == overrides


@pytest.mark.parametrize("option", ["--cores=3", "-c3", "-j", "--profile"])
def test_cores_are_chosen_only_when_the_user_does_not(option):
    assert "--cores" in snakemake_command([], [], ["-n"])
    assert "--cores" not in snakemake_command([], [], [option])


def test_the_command_is_shown_as_a_shell_would_take_it():
    typed = typed_command(["figure_residue"], ["surface=[poisson]"], ["--dry-run"])
    assert typed == "morphoskel run figure_residue 'surface=[poisson]' -- --dry-run"
    assert typed_command([], [], []) == "morphoskel run"


def test_the_repository_is_found_from_below():
    assert find_repository(REPOSITORY / "src" / "morphoskel") == REPOSITORY


@pytest.fixture
def locked(tmp_path):
    (tmp_path / ".snakemake" / "locks").mkdir(parents=True)
    (tmp_path / ".snakemake" / "locks" / "0.input.lock").write_text("")
    return tmp_path


def test_a_stale_lock_is_released(locked):
    release_stale_lock(locked)
    assert not list((locked / ".snakemake" / "locks").iterdir())


def test_the_lock_of_a_living_run_stays(locked):
    script = locked / "snakemake"
    script.write_text("import time; time.sleep(60)")
    living = subprocess.Popen([sys.executable, str(script)], cwd=locked)
    try:
        with pytest.raises(MorphoSkelError, match=rf"process {living.pid}"):
            release_stale_lock(locked)
        assert list((locked / ".snakemake" / "locks").iterdir())
    finally:
        living.kill()
        living.wait()


def test_ctrl_c_leaves_snakemake_the_time_to_clean_up(tmp_path):
    tidy = (
        "import pathlib, signal, time\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # ignored where a shell started this behind itself
        f"here = pathlib.Path({str(tmp_path)!r})\n"
        "(here / 'lock').touch()\n"
        "try:\n    time.sleep(60)\n"
        "except KeyboardInterrupt:\n    time.sleep(1)\n    (here / 'lock').unlink()\n    raise SystemExit(7)\n"
    )
    call = (
        "import signal, subprocess, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from morphoskel.workflow_run import wait_patiently\n"
        f"sys.exit(wait_patiently(subprocess.Popen([sys.executable, '-c', {tidy!r}])))\n"
    )
    run = subprocess.Popen([sys.executable, "-c", call], start_new_session=True)
    while not (tmp_path / "lock").exists():
        assert run.poll() is None
        time.sleep(0.05)
    os.killpg(run.pid, signal.SIGINT)
    assert run.wait(timeout=60) == 7
    assert not (tmp_path / "lock").exists()
