"""The smallest experiment through a SLURM cluster of one node, and what happens there when jobs or the run are killed.

It takes several minutes and needs SLURM, so it is collected only where it is named: ``make test-cluster``.
"""

import csv
import hashlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
from conftest import REPOSITORY
from slurm_cluster import slurm_cluster

pytestmark = pytest.mark.timeout(3 * 3600)  # on a busy machine; undisturbed, a few minutes

TARGETS = os.environ.get("CLUSTER_TARGETS", "").split()
"""What is built both ways, and with which values; nothing stands for the whole smoke experiment."""

COMPARED = ("tables", "skeletons", "medial_axis", "priors", "samples", "labelled_points", "evaluation")
"""Folders of results that do not depend on where they were computed."""

TIMES = ("processing_time.csv", "status.csv")
"""Tables in them that hold little but times."""

RENDERINGS = (".md", ".tex", ".sha256", "")
"""Suffixes of files that say again what others say, seconds included: other forms of tables, and checksums."""

IMPATIENT = ("--slurm-init-seconds-before-status-checks=3", "--seconds-between-status-checks=2", "--latency-wait=5")
"""Short waits, for a cluster without other users and with a file system of its own."""

MANIFEST = "resources/manifest/synthetic_smoke.csv"


def linked_repository(target: Path) -> Path:
    """Return a folder for results of their own, whose code is this repository's, with what is compiled of it."""
    target.mkdir()
    for name in ("Snakefile", "workflow", "config", "profiles", "src", "environment.yml"):
        (target / name).symlink_to(REPOSITORY / name)
    return target


def morphoskel_run(repository: Path, *words: str, on: dict[str, str] | None = None) -> subprocess.Popen[str]:
    """Start ``morphoskel run`` on this machine, or on a cluster; its output goes to ``run.log``."""
    options = ["--", "--profile", "profiles/slurm", *IMPATIENT] if on else []
    variables = os.environ | {"PYTHONPATH": str(REPOSITORY / "src")} | (on or {})
    with (repository / "run.log").open("a") as log:
        return subprocess.Popen(
            [sys.executable, "-m", "morphoskel.cli", "run", *words, "experiment=smoke", *options],
            cwd=repository, env=variables, stdout=log, stderr=subprocess.STDOUT, text=True, start_new_session=True,
        )  # fmt: skip


def wait_for(process: subprocess.Popen[str], repository: Path) -> str:
    """Wait until a run ends well, and return all that it printed; whatever happens, it has ended afterwards."""
    try:
        code = process.wait()
    finally:
        kill_run(process)
    printed = (repository / "run.log").read_text()
    assert code == 0, printed[-6000:]
    return printed


def kill_run(process: subprocess.Popen[str]) -> None:
    """Kill Snakemake and all that it started on this machine, so that it cannot cancel what it submitted."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        return
    process.wait()


def first_job(rule: str, cluster: dict[str, str]) -> str:
    """Return the number of the first job of a rule, once it is at work.

    A job that is cancelled in its first moment may leave a process behind, as the cluster has no cgroups.
    """
    command = ["squeue", "--noheader", "--states=RUNNING", "--format=%i %k"]
    deadline = time.monotonic() + 600
    while time.monotonic() < deadline:
        listed = subprocess.run(command, env=os.environ | cluster, capture_output=True, text=True, check=False)
        for line in listed.stdout.splitlines():
            number, _, comment = line.partition(" ")
            if comment.startswith(f"rule_{rule}"):
                time.sleep(3)
                return number
        time.sleep(0.1)
    raise AssertionError(f"no job of {rule} was started")


def cancel(job: str, cluster: dict[str, str]) -> None:
    """Cancel a job, and wait until the cluster has forgotten it."""
    subprocess.run(["scancel", job], env=os.environ | cluster, check=True)
    listing = ["squeue", "--noheader", f"--jobs={job}"]
    while subprocess.run(listing, env=os.environ | cluster, capture_output=True, check=False).stdout.strip():
        time.sleep(0.1)


def wait_for_processes(repository: Path) -> None:
    """Wait until no process works in a folder: without cgroups, those of a job may end a little later than the job."""
    deadline = time.monotonic() + 60
    while any(process.info["cwd"] == str(repository) for process in psutil.process_iter(["cwd"])):
        assert time.monotonic() < deadline, f"{repository}: a process of a cancelled job is still at work"
        time.sleep(0.1)


def contents(repository: Path) -> dict[str, str]:
    """Return the results that have to be the same wherever they were computed, by their paths.

    Tables are compared in their CSV form, without measured seconds.
    """
    run = repository / "results" / "smoke"
    files = [path for folder in COMPARED for path in (run / folder).rglob("*") if path.is_file()]
    kept = [path for path in files if path.suffix not in RENDERINGS and path.name not in TIMES]
    return {
        str(path.relative_to(run)): without_seconds(path)
        if path.suffix == ".csv"
        else hashlib.sha256(path.read_bytes()).hexdigest()
        for path in kept
    }


def without_seconds(path: Path) -> str:
    """Return a table as text, without the rows and columns that hold times."""
    with path.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    kept = [row for row in rows if row.get("metric") != "seconds"]
    return "\n".join(str({name: value for name, value in row.items() if name != "seconds"}) for row in kept)


@pytest.fixture(scope="module")
def cluster():
    with slurm_cluster() as variables:
        yield variables


def test_the_cluster_computes_the_same_bits_as_this_machine(cluster, tmp_path):
    here, there = (linked_repository(tmp_path / name) for name in ("here", "there"))
    wait_for(morphoskel_run(here, *TARGETS), here)
    printed = wait_for(morphoskel_run(there, *TARGETS, on=cluster), there)
    assert "has been submitted with SLURM jobid" in printed
    assert "Trying to restart job" not in printed  # every job got along with the memory and time that it asked for
    expected = contents(here)
    assert any(name.startswith("tables/") for name in expected)
    assert any(name.startswith("skeletons/") for name in expected)
    assert contents(there) == expected


def test_a_cancelled_job_is_submitted_again(cluster, tmp_path):
    repository = linked_repository(tmp_path / "repository")
    process = morphoskel_run(repository, MANIFEST, on=cluster)
    try:
        cancel(first_job("generate_synthetic", cluster), cluster)
    except BaseException:
        kill_run(process)
        raise
    printed = wait_for(process, repository)
    assert "SLURM status is: 'CANCELLED'" in printed
    assert "Trying to restart job" in printed
    assert (repository / MANIFEST).exists()


def test_a_killed_run_goes_on(cluster, tmp_path):
    repository = linked_repository(tmp_path / "repository")
    process = morphoskel_run(repository, MANIFEST, on=cluster)
    try:
        orphan = first_job("generate_synthetic", cluster)
    finally:
        kill_run(process)
    cancel(orphan, cluster)
    wait_for_processes(repository)
    printed = wait_for(morphoskel_run(repository, MANIFEST, on=cluster), repository)
    assert "its lock is removed" in printed
    assert (repository / MANIFEST).exists()
    assert not list(repository.rglob("*.partial"))
