from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

from morphoskel.errors import InputError
from morphoskel.evaluation.scaling import SCALED_STAGES
from morphoskel.methods import METHODS
from morphoskel.reporting.figures.against_ratio import PANELS
from morphoskel.reporting.figures.distances import SKELETON_ROWS, SURFACE_ROWS
from morphoskel.reporting.figures.marks import MARKS, TOTAL, mark_of
from morphoskel.reporting.names import SURFACE_NAMES
from morphoskel.reporting.segmentation_names import FULL
from morphoskel.sampling.samplers import SAMPLERS
from morphoskel.stages import TIMED_STAGES

CHARTS = [*PANELS.values(), tuple(SKELETON_ROWS), tuple(SURFACE_ROWS), (TOTAL, *SCALED_STAGES),
          ("random", "fps", "lfs", "ms3d", "uniform", FULL)]  # fmt: skip

# Machado, Oliveira and Fernandes, IEEE TVCG 2009: linear RGB as seen without one kind of cone.
CONES = {
    "all": np.eye(3),
    "no long": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "no medium": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "no short": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def as_seen(colour, cones):
    """CIELAB coordinates, in which a distance of about 2 can just be noticed."""
    channels = np.array(to_rgb(colour))
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    xyz = TO_XYZ @ np.clip(np.array(CONES[cones]) @ linear, 0, 1) / TO_XYZ.sum(axis=1)
    x, y, z = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def test_everything_that_can_be_drawn_has_a_mark():
    for name in (*SAMPLERS, *METHODS, *SURFACE_NAMES, *TIMED_STAGES, FULL, TOTAL):
        assert mark_of(name).marker in Line2D.filled_markers


def test_an_unknown_name_is_refused():
    with pytest.raises(InputError, match=r"no mark for 'msd3'; known are .*ms3d"):
        mark_of("msd3")


def distance(first, second, cones):
    return np.linalg.norm(as_seen(MARKS[first].colour, cones) - as_seen(MARKS[second].colour, cones))


@pytest.mark.parametrize("cones", CONES)
@pytest.mark.parametrize("chart", CHARTS)
def test_colours_of_one_chart_differ_for_every_reader(chart, cones):
    for first, second in combinations(chart, 2):
        assert distance(first, second, cones) > 25, (first, second)


@pytest.mark.parametrize("cones", CONES)
def test_stages_beside_each_other_in_a_bar_differ_for_every_reader(cones):
    for first, second in pairwise(TIMED_STAGES):
        assert distance(first, second, cones) > 25, (first, second)


@pytest.mark.parametrize("chart", CHARTS)
def test_markers_of_one_chart_differ(chart):
    assert len({MARKS[name].marker for name in chart}) == len(chart)


def test_no_two_samplers_look_alike():
    assert len({(MARKS[name].colour, MARKS[name].marker) for name in SAMPLERS}) == len(SAMPLERS)
    assert len({MARKS[name].colour for name in SAMPLERS}) == len(SAMPLERS)


def test_ms3d_is_larger_and_thicker_and_hides_nothing():
    others = [mark_of(name) for name in SAMPLERS if name != "ms3d"]
    ms3d = mark_of("ms3d")
    assert ms3d.line["linewidth"] > 2 * max(mark.line["linewidth"] for mark in others)
    assert ms3d.line["zorder"] < min(mark.hollow["zorder"] for mark in others)
    assert mark_of("poisson") == ms3d


def test_a_published_value_is_a_ring_around_an_equal_own_one():
    for mark in MARKS.values():
        assert mark.hollow["markersize"] > 1.2 * mark.dot["markersize"]
        assert mark.hollow["zorder"] < mark.dot["zorder"]
        assert mark.hollow["markerfacecolor"] == "white"
        assert mark.hollow["markeredgecolor"] == mark.colour
