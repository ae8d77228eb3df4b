import os
import subprocess
import sys
from pathlib import Path

import pytest

CHAIN = """
import numpy as np
import torch
from solids import torus
import morphoskel.chain.compiler
from morphoskel import skeletonize
from morphoskel.formats.sample import sample_surface
from morphoskel.methods import METHODS
from morphoskel.morphology import dilation, opening
from morphoskel.networks.edge_features import EdgeFeatures
from morphoskel.skeleton import ms3d
from morphoskel.skeleton.medial_axis import medial_axis_of_mesh
from morphoskel.volume import Candidates
for mode in ("random", "grid"):
    skeleton = ms3d(torus(), Candidates(*torus().bounds, 5000, mode), threads=2)
for operation in (dilation, opening):
    operation(skeleton.points.astype("f4"), skeleton.radii.astype("f4"), threads=2)
cloud = sample_surface(torus(), 400, np.random.default_rng(0))
for method in set(METHODS) - {"point2skeleton"}:
    skeletonize(cloud, method=method, candidates=5000, points=16, threads=2)
skeletonize(torus(), method="coverage_axis", candidates=5000, points=16, settings={"penalty": "standardised"})
medial_axis_of_mesh(torus(), np.random.default_rng(0), samples=2000)
features = EdgeFeatures(k=20, channels=(16, 32), global_features=16, head=(16, 8))
features(torch.rand(2, 64, 3)).sum().backward()
features.eval()(torch.rand(1, 64, 3))
"""


@pytest.mark.slow
def test_no_kernel_is_left_to_compile_for_a_job(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    subprocess.run([sys.executable, "-m", "morphoskel.precompile"], env=environment, check=True)
    compiled = {path.name for path in tmp_path.rglob("*.nbc")}
    subprocess.run([sys.executable, "-c", CHAIN], env=environment, cwd=Path(__file__).parent, check=True)
    assert len(compiled) > 50
    assert {path.name for path in tmp_path.rglob("*.nbc")} == compiled
