import subprocess
import sys

import pytest

from morphoskel.config.schema import Methods
from morphoskel.errors import ConfigError
from morphoskel.methods import CLOUD_METHODS, METHODS, MORPHOLOGICAL, RANKED, SURFACE_METHODS, check_method


def test_every_method_reads_the_surface_or_the_cloud_alone():
    assert len(set(METHODS)) == len(METHODS)
    assert set(METHODS) == set(SURFACE_METHODS) ^ set(CLOUD_METHODS)
    assert set(METHODS) > RANKED


def test_every_method_is_configured_by_its_name():
    assert set(Methods.model_fields) == set(METHODS) - set(MORPHOLOGICAL)


@pytest.mark.parametrize(
    ("name", "message"),
    [("ms3d-coverage", "did you mean 'ms3d_coverage'"), ("deep", "Legal: ms3d, .*, point2skeleton$"), (3, "method 3")],
)
def test_a_wrong_name_is_refused_with_the_legal_ones(name, message):
    with pytest.raises(ConfigError, match=message):
        check_method(name)


def test_the_names_are_quick_to_import():
    code = "import sys, morphoskel.methods; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
