"""A bounded number of damaged files for every reader, and the harness that makes and judges them."""

import contextlib
import faulthandler
import io
import json
import logging
import os
import random
import signal
import time
import zipfile

import numpy as np
import pytest
from fuzz import guarded, loop
from fuzz.judge import READ, REFUSED, Finding, judge
from fuzz.loop import fuzz, minimise
from fuzz.mutations import mutate
from fuzz.readers import READERS, Reader
from fuzz.record import COUNTS, PAGE, render
from fuzz.regressions import REGRESSIONS

from morphoskel.errors import InputError
from morphoskel.seeds import derive_seed

SLOW = {"archive", "configuration", "run_configuration", "configuration_values", "illustration"}
NETWORKS = {name for name in READERS if name.startswith("network_")}


@pytest.fixture(autouse=True)
def quiet(caplog):
    caplog.set_level(logging.CRITICAL)


def prepared(name, folder):
    reader = READERS[name]
    path = folder / reader.file
    path.parent.mkdir(parents=True, exist_ok=True)
    seeds = reader.seeds(folder)
    reader.warm_up(path, seeds)
    return reader, path, seeds


@pytest.mark.parametrize("name", [name for name in READERS if name != "configuration"])
def test_damaged_files_are_read_or_refused_by_name(name, tmp_path):
    reader, path, seeds = prepared(name, tmp_path)
    count = len(seeds) + (20 if name in SLOW | NETWORKS else 100)
    generator = random.Random(derive_seed(0, name))
    *_, tally = fuzz(reader.read, path, seeds, count=count, generator=generator, guided=False)
    assert tally.findings == {}
    assert tally.outcomes[READ] + tally.outcomes[REFUSED] == count


@pytest.mark.parametrize("regression", REGRESSIONS, ids=lambda regression: f"{regression.reader}: {regression.what}")
def test_what_was_handled_wrongly_once_is_refused(regression, tmp_path):
    reader = READERS[regression.reader]
    path = tmp_path / reader.file
    path.parent.mkdir(parents=True, exist_ok=True)
    reader.seeds(tmp_path)
    path.write_bytes(regression.content)
    assert judge(reader.read, path, regression.content) == REFUSED


def judged(action, tmp_path):
    path = tmp_path / "shape.ply"
    path.write_bytes(b"x")
    return judge(lambda path: action(path), path, b"x")


def refuse(message):
    raise InputError(message)


def warn():
    return np.array([1e300]).astype(np.float32)


def test_the_judge_tells_right_from_wrong(tmp_path):
    def hidden(path):
        try:
            np.empty(1 << 50)
        except MemoryError as error:
            raise InputError(f"{path}: too large") from error

    assert judged(lambda path: 1, tmp_path) == READ
    assert judged(lambda path: refuse(f"{path}: damaged"), tmp_path) == REFUSED
    assert judged(lambda path: refuse("damaged"), tmp_path).kind == "nameless"
    assert judged(lambda path: warn(), tmp_path).kind == "error"
    assert judged(hidden, tmp_path).kind == "memory"


def test_slow_readers_are_found(tmp_path, monkeypatch):
    clock = iter([0.0, 3.0, 3.0])
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    assert judged(lambda path: 1, tmp_path).kind == "slow"


def crash():
    faulthandler.disable()  # what it prints would look like a fault of the tests
    os.kill(os.getpid(), signal.SIGSEGV)


def hang():
    while True:
        pass


@pytest.mark.parametrize(("fault", "kind"), [(crash, "crash"), (hang, "hang")])
def test_a_process_that_dies_is_found_with_its_input(fault, kind, monkeypatch):
    def read(function, path):
        if path.read_bytes() != b"a file":
            fault()

    monkeypatch.setitem(READERS, "faulty", Reader("shapes:Mesh", "a.bin", lambda folder: [b"a file"], read))
    monkeypatch.setattr(guarded, "MOST_CPU_SECONDS", 1)
    result = guarded.fuzz_reader("faulty", count=2, seed=0)
    assert {finding.kind for finding in result.findings} == {kind}
    assert all(finding.content != b"a file" for finding in result.findings)


def test_the_seed_decides_the_inputs(tmp_path):
    def inputs(seed):
        found = []
        tallies = fuzz(lambda path: found.append(path.read_bytes()), tmp_path / "a", [b"1 2 3\n4 5 6\n", b"PK\3\4"],
                       count=60, generator=random.Random(seed))  # fmt: skip
        assert list(tallies)[-1].outcomes == {READ: 60}
        return found

    assert inputs(1) == inputs(1) != inputs(2)
    assert inputs(1)[:2] == [b"1 2 3\n4 5 6\n", b"PK\3\4"]


def test_inputs_that_reach_new_lines_are_kept(tmp_path):
    reader, path, seeds = prepared("text", tmp_path)
    *_, tally = fuzz(reader.read, path, seeds, count=200, generator=random.Random(0))
    assert tally.kept > len(seeds)
    assert tally.steps > 50


def test_a_finding_becomes_as_small_as_it_can_be(tmp_path):
    def read(path):
        if b"bad" in path.read_bytes():
            raise KeyError("bad")

    path = tmp_path / "a"
    content = b"much before bad and after"
    path.write_bytes(content)
    assert minimise(judge(read, path, content), read, path).content == b"bad"


@pytest.mark.parametrize("name", ["npz", "network_generator", "archive"])
def test_archives_are_damaged_inside_and_still_open(name, tmp_path):
    _, _, seeds = prepared(name, tmp_path)
    seeds = [seed for seed in seeds if seed.startswith(b"PK")]
    generator = random.Random(0)
    mutants = [mutate(generator.choice(seeds), generator, seeds) for _ in range(60)]
    opened = 0  # others cannot be opened any more, for all sorts of reasons
    for mutant in set(mutants) - set(seeds):
        with contextlib.suppress(Exception), zipfile.ZipFile(io.BytesIO(mutant)) as archive:
            opened += archive.testzip() is None
    assert opened > 5


def test_findings_are_told_apart_and_the_smallest_is_kept():
    tally = loop.Tally()
    for kind, where, content in (
        ("error", "a", b"123"),
        ("error", "a", b"1"),
        ("error", "a", b"12"),
        ("hang", "a", b""),
    ):
        tally.add(Finding(kind, where, content))
    assert [(finding.kind, finding.content) for finding in tally.findings.values()] == [("error", b"1"), ("hang", b"")]


def test_the_page_says_what_was_recorded():
    assert PAGE.read_text(encoding="utf-8") == render(json.loads(COUNTS.read_text(encoding="utf-8")))
