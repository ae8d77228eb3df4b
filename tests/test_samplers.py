import subprocess
import sys

import pytest

from morphoskel.errors import ConfigError
from morphoskel.methods import METHODS
from morphoskel.sampling.samplers import (
    GENERATORS,
    LEARNED,
    LEARNED_SKELETON,
    PRIORS,
    SAMPLERS,
    SKELETON_OF,
    TRAINING_FREE,
    check_sampler,
)


def test_every_sampler_is_of_one_kind():
    assert len({*SAMPLERS}) == len(SAMPLERS) == len(TRAINING_FREE) + len(GENERATORS) + len(PRIORS)
    assert set(LEARNED).isdisjoint(TRAINING_FREE)


def test_every_skeleton_is_learned_or_a_method():
    assert set(SKELETON_OF) == {"lfs", *PRIORS} - {"uniform"}
    assert set(SKELETON_OF.values()) <= {LEARNED_SKELETON, *METHODS}
    assert SKELETON_OF["shuffled"] == SKELETON_OF["lfs"] == SKELETON_OF["ms3d"]


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_legal_names_pass(sampler):
    check_sampler(sampler)


@pytest.mark.parametrize(("name", "guess"), [("sample_net", "did you mean 'samplenet'"), ("qqq", "Legal: random")])
def test_an_unknown_name_is_refused_with_the_nearest(name, guess):
    with pytest.raises(ConfigError, match=f"no such sampler '{name}'; .*{guess}"):
        check_sampler(name)


def test_the_names_cost_no_heavy_import():
    code = "import sys, morphoskel.sampling.samplers; print(sorted({'torch', 'numpy', 'scipy'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True).stdout == "[]\n"
