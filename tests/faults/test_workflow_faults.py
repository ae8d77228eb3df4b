"""What a rerun makes of a run that was killed, damaged or starved of disk: equal tables, or a failure with reasons."""

import os
import shutil
import subprocess
import sys
import time

import psutil
import pytest
from conftest import REPOSITORY
from faults_in_files import DAMAGE, mounted
from injection import INJECTED, environment, fault
from workflow_copy import copy_repository, run

pytestmark = [pytest.mark.workflow, pytest.mark.faults, pytest.mark.timeout(3600)]

WORDS = ["table_skeleton_reconstruction", "experiment=smoke", "run=faults", "dataset.categories=[Mug]",
         "surface=[poisson]", "skeleton=[ms3d,point2skeleton]", "sampler=[]", "task=[]"]  # fmt: skip
RESULTS = "results/faults"
SET = "synthetic_smoke"
SHARD = f"{SET}/test/poisson/00000"
NETWORK = f"{RESULTS}/networks/{SET}/point2skeleton/network.pt"
EVALUATED = f"{RESULTS}/evaluation/{SET}/test/poisson/ms3d.csv"
SKELETONS = f"{RESULTS}/skeletons/{SET}/test/poisson/ms3d/00000"
PREDICTED = f"{RESULTS}/skeletons/{SET}/test/cloud/point2skeleton"
PREDICTED_EVALUATED = f"{RESULTS}/evaluation/{SET}/test/cloud/point2skeleton.csv"
TABLES = f"{RESULTS}/tables"
CHAIN = ["surfaces", "watertight", "occupancy", "udf", "dilation"]
TRAINED = [NETWORK, PREDICTED, PREDICTED_EVALUATED]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    repository = copy_repository(tmp_path_factory.mktemp("undisturbed") / "repository")
    run(repository, *WORDS)
    return repository


@pytest.fixture
def repository(undisturbed, tmp_path):
    """Hand out a copy of the finished run."""
    copy = tmp_path / "repository"
    shutil.copytree(undisturbed, copy)
    return copy


def tables(repository):
    """Return the lines of all tables but those with measured times."""
    lines = {path.name: path.read_text().splitlines() for path in (repository / TABLES).glob("*.csv")}
    return {name: [line for line in rows if ",seconds," not in line] for name, rows in lines.items()}


def remove(repository, *names):
    for name in names:
        path = repository / name
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def check_rerun(repository, undisturbed, *options):
    run(repository, *WORDS, *options)
    assert tables(repository) == tables(undisturbed)
    assert list(repository.rglob("*.partial")) == []


def run_with(repository, faults):
    """Run under faults; the workflow's jobs find them in the copy's own source folder."""
    shutil.copy(INJECTED / "sitecustomize.py", repository / "src")
    settings = environment(repository.parent, faults, repository / "src")
    command = [sys.executable, "-m", "morphoskel.cli", "run", *WORDS]
    return subprocess.run(command, cwd=repository, env=settings, capture_output=True, text=True)


@pytest.mark.parametrize(
    ("rule", "module", "function", "again"),
    [
        ("train_point2skeleton", "learning.resumable_fit", "BatchedPhase.validation_step", TRAINED),
        ("train_point2skeleton", "learning.epoch_records", "LastEpoch.on_train_epoch_end", TRAINED),
        ("evaluate_skeletons", "evaluation.skeletons", "_measure", [EVALUATED]),
    ],
)
def test_a_killed_job_fails_by_name_and_is_run_again(repository, undisturbed, rule, module, function, again):
    if rule == "train_point2skeleton":
        remove(repository, f"{RESULTS}/checkpoints")
    remove(repository, *again, TABLES)
    done = run_with(repository, [fault(module, function, "kill", marker=repository.parent / "happened")])
    output = done.stdout + done.stderr
    assert done.returncode != 0
    assert f"Error in rule {rule}" in output
    assert f"{RESULTS}/logs/{rule}" in output
    assert not (repository / TABLES).exists() or tables(repository) == {}
    check_rerun(repository, undisturbed)


def test_a_killed_snakemake_goes_on(repository, undisturbed):
    remove(repository, RESULTS)
    command = [sys.executable, "-m", "morphoskel.cli", "run", *WORDS]
    first = subprocess.Popen(command, cwd=repository, env=environment(repository.parent, [], repository / "src"),
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    while not list((repository / RESULTS).glob(f"watertight/{SHARD}*")):  # the next stage has not begun
        assert first.poll() is None
        time.sleep(0.05)
    [snakemake] = psutil.Process(first.pid).children()
    snakemake.kill()
    assert first.wait() != 0
    deadline = time.monotonic() + 600
    while "a run is at work here" in (output := run_anyhow(repository)) and time.monotonic() < deadline:
        time.sleep(1)  # a job may outlive Snakemake, and a second run is refused until it ends
    assert "its lock is removed" in output
    check_rerun(repository, undisturbed)


def run_anyhow(repository):
    command = [sys.executable, "-m", "morphoskel.cli", "run", *WORDS]
    settings = environment(repository.parent, [], repository / "src")
    done = subprocess.run(command, cwd=repository, env=settings, capture_output=True, text=True)
    return done.stdout + done.stderr


@pytest.mark.parametrize("how", DAMAGE)
@pytest.mark.parametrize(
    ("name", "culprit", "again"),
    [
        (f"resources/manifest/{SET}.csv", f"resources/manifest/{SET}.csv", [SKELETONS, EVALUATED]),
        (f"{SKELETONS}/mug-test-0000.ply", SKELETONS, [EVALUATED]),
        (EVALUATED, EVALUATED, []),
        (NETWORK, NETWORK, [PREDICTED, PREDICTED_EVALUATED]),
    ],
    ids=["manifest", "skeleton", "evaluation", "network"],
)
def test_a_damaged_file_is_refused_until_it_is_made_again(repository, undisturbed, name, culprit, again, how):
    damaged = repository / name
    before = damaged.stat()
    DAMAGE[how](damaged)
    os.utime(damaged, ns=(before.st_atime_ns, before.st_mtime_ns))  # a disk does not tell what it loses
    remove(repository, *again, TABLES)  # what reads the file, and all that follows
    output = run(repository, *WORDS, check=False)
    assert f"{name}: is damaged" in output
    assert f"remove {culprit} and run again" in output
    assert not (repository / TABLES).exists() or tables(repository) == {}
    remove(repository, culprit)
    check_rerun(repository, undisturbed)


@pytest.mark.parametrize("how", DAMAGE)
@pytest.mark.parametrize(("name", "said"), [("last.ckpt", "starts anew"), ("network.pt", "is written again")])
def test_a_damaged_checkpoint_is_not_used(repository, undisturbed, name, said, how):
    checkpoints = repository / RESULTS / "checkpoints"
    for path in checkpoints.rglob(name):
        DAMAGE[how](path)
    if name == "last.ckpt":  # beside the network of a finished training, it would not be read
        for path in checkpoints.rglob("network.pt"):
            path.unlink()
    remove(repository, *TRAINED, TABLES)
    check_rerun(repository, undisturbed)
    assert said in (repository / RESULTS / "logs/train_point2skeleton.log").read_text()
    assert (repository / NETWORK).read_bytes() == (undisturbed / NETWORK).read_bytes()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can mount a small disk to fill it")
def test_a_full_disk_is_told_and_a_rerun_goes_on(repository, undisturbed):
    remove(repository, RESULTS)
    with mounted(repository / RESULTS, "200k"):
        output = run(repository, *WORDS, check=False)
        left = list((repository / RESULTS).rglob("*.partial"))
    assert "No space left on device" in output or "has space left" in output
    assert left == []
    check_rerun(repository, undisturbed)


def test_an_unreadable_input_is_named_with_shape_stage_and_log(repository, undisturbed):
    cloud = repository / f"resources/data/{SET}/clouds/Mug/mug-test-0001.ply"
    content = cloud.read_bytes()
    cloud.unlink()
    cloud.symlink_to("nowhere")
    remove(repository, *(f"{RESULTS}/{stage}" for stage in CHAIN), f"{RESULTS}/skeletons/{SET}/test/poisson")
    remove(repository, EVALUATED, TABLES)
    output = run(repository, *WORDS, check=False)
    assert "mug-test-0001: reconstruct: InputError" in output
    assert f"(log: {RESULTS}/logs/reconstruct/{SHARD}.log)" in output
    cloud.unlink()
    cloud.write_bytes(content)
    assert "--forcerun STAGE" in output
    check_rerun(repository, undisturbed, "--", "--forcerun", "reconstruct", "point2skeleton")


def test_the_library_has_no_switch_for_faults():
    """What breaks the runs above lies in the tests alone."""
    assert not [path for path in (REPOSITORY / "src").rglob("*.py") if "MORPHOSKEL_FAULTS" in path.read_text()]
