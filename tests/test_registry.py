import subprocess
import sys

import pytest

from morphoskel.datasets.dataset import Dataset
from morphoskel.datasets.registry import KINDS, open_dataset
from morphoskel.errors import ConfigError


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "synthetic"])
def test_every_kind_opens_without_its_folder_and_tells_how_to_get_it(tmp_path, kind):
    root = tmp_path / "nowhere"
    dataset = open_dataset(kind, root=root)
    assert isinstance(dataset, Dataset)
    assert str(root) in dataset.how_to_get


def test_unknown_kinds_and_options():
    with pytest.raises(ConfigError, match=r"unknown kind 'modelnet4'\. Did you mean 'modelnet40'\? Legal kinds: synth"):
        open_dataset("modelnet4", root="x")
    with pytest.raises(ConfigError, match="'folder': got an unexpected keyword argument 'rot'; its options are root,"):
        open_dataset("folder", root="x", rot=1)
    with pytest.raises(ConfigError, match="missing a required argument: 'root'"):
        open_dataset("folder")


def test_planning_imports_nothing_heavy(tmp_path):
    (tmp_path / "a.ply").touch()
    code = (
        "import sys\n"
        "from morphoskel.datasets import KINDS, open_dataset\n"
        "for kind in set(KINDS) - {'synthetic'}: open_dataset(kind, root=sys.argv[1])\n"
        "assert open_dataset('folder', root=sys.argv[1]).counts() == {'test': 1}\n"
        "import morphoskel.datasets.download, morphoskel.datasets.extract\n"
        "heavy = {'open3d', 'torch', 'trimesh', 'pandas', 'scipy', 'matplotlib', 'numba', 'tqdm'} & set(sys.modules)\n"
        "sys.exit(f'imported {heavy}' if heavy else 0)\n"
    )
    done = subprocess.run([sys.executable, "-c", code, tmp_path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
