"""Data never run code: the sources are searched for calls that would let them."""

import re

import pytest
from conftest import REPOSITORY
from source_scan import findings

SOURCES = sorted(path for name in ("src", "workflow", "benchmarks") for path in (REPOSITORY / name).rglob("*.py"))
RULES = [REPOSITORY / "Snakefile", *sorted((REPOSITORY / "workflow").rglob("*.smk"))]


def test_nothing_unsafe_is_called():
    assert len(SOURCES) > 300
    found = [f"{path.relative_to(REPOSITORY)}:{what}" for path in SOURCES for what in findings(path.read_text())]
    assert found == []


def test_rules_call_scripts_only():
    """A rule with a shell command would have to quote the names of files."""
    assert len(RULES) > 15
    for path in RULES:
        assert not re.search(r"^\s*(shell|run|wrapper|notebook):|\b(eval|exec|subprocess|pickle|system)\b",
                             path.read_text(), re.MULTILINE), path  # fmt: skip


@pytest.mark.parametrize(
    "source",
    [
        "import torch\ntorch.load(path)",
        "from torch import load as read\nread(path, weights_only=False)",
        "import torch\ntorch.load(path, weights_only=flag)",
        "import numpy as np\nnp.load(path)",
        "import numpy\nnumpy.load(path, allow_pickle=True)",
        "import numpy as np\nnp.save(path, array, allow_pickle=True)",
        "import numpy as np\nnp.lib.format.read_array(stream)",
        "trainer.fit(phase, ckpt_path=path)",
        "Phase.load_from_checkpoint(path)",
        "import pickle\npickle.loads(data)",
        "from pickle import Unpickler\nUnpickler(stream)",
        "import joblib",
        "from dill import load",
        "import pandas as pd\npd.read_pickle(path)",
        "import yaml\nyaml.load(text, Loader=yaml.Loader)",
        "import subprocess\nsubprocess.run(command, shell=True)",
        "import os\nos.system(command)",
        "def inner():\n    from os import popen\n    popen(command)",
        "eval(text)",
        "archive.extractall(folder)",
        "from urllib.request import urlopen\nurlopen(address)",
        "from hydra.utils import instantiate\ninstantiate(section)",
    ],
)
def test_what_is_unsafe_is_found(source):
    assert list(findings(source)) != []


@pytest.mark.parametrize(
    "source",
    [
        "import torch\ntorch.load(path, map_location='cpu', weights_only=True)",
        "import numpy as np\nnp.load(path, allow_pickle=False)",
        "import pickle\ntry:\n    pass\nexcept pickle.UnpicklingError:\n    pass",
        "network.eval()",
        "import subprocess\nsubprocess.run(['git', name], check=True)",
        "trainer.fit(phase, ckpt_path=path, weights_only=True)",
        "import re\nre.compile(text)",
    ],
)
def test_what_is_safe_is_not(source):
    assert list(findings(source)) == []
