import re

import pytest
from conftest import REPOSITORY
from measured_run import config

from morphoskel.planning.extent import Extent
from morphoskel.planning.work import WORK, fingerprint

RULES = "\n".join(path.read_text() for path in (REPOSITORY / "workflow" / "rules").glob("*.smk"))
EXTENT = Extent(config(), {"synthetic": {"train": 20, "test": 6}})


@pytest.mark.parametrize("rule", WORK)
def test_benchmarks_lie_where_the_workflow_puts_them(rule):
    layout = WORK[rule].layout
    path = f"<benchmarks>/{rule}/{layout}" if layout else f"<benchmarks>/{rule}"
    if rule == "train_sampler":
        path = path.replace("{", "{{").replace("}", "}}") + "/{TRAINING}"
    assert f'"{path}.tsv"' in RULES


@pytest.mark.parametrize("rule", [rule for rule, work in WORK.items() if work.threads])
def test_cores_are_those_that_the_workflow_asks_for(rule):
    [body] = re.findall(rf"rule {rule}:\n(.*?)(?:\n\s*rule |\Z)", RULES, re.DOTALL)
    [threads] = re.findall(r"threads: CONFIG\.(\S+)", body)
    assert WORK[rule].threads == threads


def test_other_settings_make_another_fingerprint():
    job = {"dataset": "synthetic", "split": "test", "surface": "poisson", "shard": "00000"}
    work = WORK["reconstruct"]
    other = Extent(config("surface.poisson.depth=6"), EXTENT.counts)
    more_candidates = Extent(config("skeleton.candidates.count=9999"), EXTENT.counts)
    assert fingerprint(work, EXTENT, job) == fingerprint(work, more_candidates, job)
    assert fingerprint(work, EXTENT, job) != fingerprint(work, other, job)


def test_epochs_are_scaled_with_and_sizes_must_agree():
    work, classifier = WORK["train_classifier"], {"dataset": "synthetic", "classifier": "task"}
    longer = Extent(config("tasks.classification.classifier.epochs=60"), EXTENT.counts)
    larger = Extent(config("tasks.classification.classifier.batch_size=5"), EXTENT.counts)
    assert work.amount(longer, classifier) == 2 * work.amount(EXTENT, classifier)
    assert fingerprint(work, EXTENT, classifier) == fingerprint(work, longer, classifier)
    assert fingerprint(work, EXTENT, classifier) != fingerprint(work, larger, classifier)


def test_a_job_for_all_ratios_trains_several_times():
    work = WORK["train_sampler"]
    together = work.amount(EXTENT, {"dataset": "synthetic", "sampler": "snet"})
    alone = work.amount(EXTENT, {"dataset": "synthetic", "sampler": "snet", "ratio": "8", "seed": "0"})
    assert together == 4 * alone
