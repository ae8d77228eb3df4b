"""Light modules stay light, and layers know only what they may."""

import ast
import json
import subprocess
import sys

import pytest
from conftest import REPOSITORY

SOURCES = sorted((REPOSITORY / "src" / "morphoskel").rglob("*.py"))
HEAVY = {"torch", "open3d", "numba", "matplotlib", "trimesh", "scipy", "pandas"}


def imported_by(statement):
    code = f"import sys, json\n{statement}\nprint(json.dumps(sorted(name.split('.')[0] for name in sys.modules)))"
    return set(json.loads(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout))


@pytest.mark.parametrize(
    "statement",
    [
        "import morphoskel",
        "import morphoskel.cli",
        "from morphoskel.config import compose; compose()",
        "import morphoskel.datasets.configured, morphoskel.provenance",
        "import morphoskel.chain.shard, morphoskel.chain.dilation",
        "import snakemake_logger_plugin_morphoskel",
    ],
)
def test_light_modules_import_nothing_heavy(statement):
    assert imported_by(statement) & HEAVY == set()


def imports(path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module.split(".")[0]


def test_the_library_knows_neither_snakemake_nor_hydra():
    assert len(SOURCES) > 40
    for path in SOURCES:
        found = set(imports(path))
        assert "snakemake" not in found, path
        if path.parent.name != "config":
            assert not found & {"hydra", "omegaconf"}, path


def test_modules_stay_short():
    long = {str(path.relative_to(REPOSITORY)): len(path.read_text().splitlines()) for path in SOURCES}
    assert {name: length for name, length in long.items() if length > 260} == {}
