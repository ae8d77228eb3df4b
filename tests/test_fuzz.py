"""A bounded number of damaged files for every reader, and the harness that makes and judges them."""

import logging
import os
import random
import signal
import time

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
