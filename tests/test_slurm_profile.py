"""The profile for SLURM clusters, and what the rules ask of a cluster."""

import dataclasses
import re
import subprocess
import sys
from collections import defaultdict

import pytest
import yaml
from conftest import REPOSITORY
from test_workflow import copy_repository, environment

pytestmark = [pytest.mark.workflow, pytest.mark.timeout(1800)]  # the first test waits for two plans

PROFILE = yaml.safe_load((REPOSITORY / "profiles" / "slurm" / "config.yaml").read_text())
LOCAL_RULES = {"all", "write_config"}  # run where Snakemake runs


def asked(repository, *words, attempt=1):
    """Return the resources that the jobs of the smoke experiment ask for, by rule; without those that run at once."""
    command = [sys.executable, "-m", "morphoskel.cli", "run", "experiment=smoke", *words]
    options = ["--", "--dry-run", "--attempt", str(attempt)]
    done = subprocess.run(
        [*command, *options], cwd=repository, env=environment(repository), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    jobs = defaultdict(list)
    for block in re.split(r"\n(?=(?:local)?rule \w+:\n)", done.stdout + done.stderr)[1:]:
        rule = re.match(r"(?:local)?rule (\w+):", block)[1]
        if rule in LOCAL_RULES:
            continue
        resources = re.search(r"^ +resources: (.*)$", block, re.MULTILINE)[1]
        jobs[rule].append(dict(re.findall(r"(\w+)=([^,]+)", resources)))
    return jobs


@pytest.fixture(scope="module")
def on_gpus(tmp_path_factory):
    """Hand out what is asked at the first and at the second attempt, where networks are trained on graphics cards."""
    repository = copy_repository(tmp_path_factory.mktemp("slurm") / "repository")
    words = ["trainer.accelerator=gpu", "trainer.devices=2"]
    return [asked(repository, *words, attempt=attempt) for attempt in (1, 2)]


def test_every_job_asks_for_memory_and_time(on_gpus):
    for rule, jobs in on_gpus[0].items():
        for job in jobs:
            assert 1000 <= int(job["mem_mb"]) <= 16_000, rule  # Snakemake runs twice around a job, 130 MB each time
            assert 10 <= int(job["runtime"]) <= 2880, rule
    assert len(on_gpus[0]) > 40


def test_memory_and_time_rise_with_the_attempts(on_gpus):
    first, second = on_gpus
    assert set(first) == set(second)
    for rule in first:
        # A training goes on where it was stopped, and needs no more time for the same.
        for name in ("mem_mb",) if rule.startswith("train_") else ("mem_mb", "runtime"):
            asked_first, asked_then = (sorted(int(job[name]) for job in jobs[rule]) for jobs in (first, second))
            assert [2 * amount for amount in asked_first] == asked_then, rule


def test_trainings_alone_ask_for_graphics_cards(on_gpus):
    trainings = {rule for rule in on_gpus[0] if rule.startswith("train_")}
    assert len(trainings) == 6
    asking = {rule for rule, jobs in on_gpus[0].items() if any("gpu" in job for job in jobs)}
    assert asking == trainings
    assert {job["gpu"] for rule in trainings for job in on_gpus[0][rule]} == {"2"}


def test_exclusive_rules_exist(on_gpus):
    assert set(PROFILE["set-resources"]) <= set(on_gpus[0])


def test_no_partition_and_no_account_is_assumed():
    assert not {"slurm_partition", "slurm_account"} & set(PROFILE["default-resources"])


def test_the_scheduler_is_asked_in_place_of_the_accounting():
    assert PROFILE["slurm-status-command"] == "squeue"


def test_a_failed_job_is_tried_again():
    assert PROFILE["retries"] >= 1


def test_the_plugin_knows_every_option_of_the_profile():
    plugin = pytest.importorskip("snakemake_executor_plugin_slurm", reason="needs `make slurm`")
    known = {f"slurm-{field.name}".replace("_", "-") for field in dataclasses.fields(plugin.ExecutorSettings)}
    assert {name for name in PROFILE if name.startswith("slurm-")} <= known


def test_snakemake_reads_the_profile(monkeypatch):
    pytest.importorskip("snakemake_executor_plugin_slurm", reason="needs `make slurm`")
    from snakemake.cli import get_argument_parser

    monkeypatch.chdir(REPOSITORY)
    arguments = get_argument_parser(profiles=["profiles/slurm"]).parse_args([])
    assert arguments.executor == "slurm"
    assert arguments.jobs == PROFILE["jobs"]
    assert arguments.retries == PROFILE["retries"]
