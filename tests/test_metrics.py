import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.metrics import METRICS, find_metric


def test_headings_tell_unit_and_direction():
    assert find_metric("cd_recon").heading == "CD-Recon (lower is better)"
    assert find_metric("oa").heading == "Overall accuracy (%, higher is better)"
    assert find_metric("seconds").heading == "Time a shape (seconds)"


def test_decimals_are_those_of_the_paper():
    assert [METRICS[name].decimals for name in ("hd_mat", "seconds", "map")] == [4, 2, 1]


def test_an_unknown_metric_is_named_with_the_known_ones():
    with pytest.raises(InputError, match=r"no metric 'chamfer'; known are cd_recon, "):
        find_metric("chamfer")
