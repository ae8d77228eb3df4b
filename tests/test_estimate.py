import dataclasses

import pytest
from measured_run import SECONDS, SHAPES, config, write_measured_run

from morphoskel.planning.estimate import estimate
from morphoskel.planning.extent import Extent
from morphoskel.planning.jobs import Job
from morphoskel.planning.measurements import measure_run


@pytest.fixture
def measured(tmp_path):
    return measure_run(write_measured_run(tmp_path / "small"))


def job(rule, shard, surface="poisson"):
    wildcards = {"dataset": "synthetic", "split": "test", "surface": surface, "shard": f"{shard:05d}"}
    return Job(rule, wildcards, 4, 0, (), (f"{rule}/{surface}/{shard}",))


def extent(shapes, *overrides):
    return Extent(config(*overrides), {"synthetic": {"test": shapes}})


def test_the_measured_run_is_given_back(measured):
    jobs = [job(rule, shard) for rule in SECONDS for shard in range(2)]
    plan = estimate(jobs, extent(SHAPES), measured)
    for row, each in zip(plan.rows, measured, strict=True):
        assert (row.rule, row.jobs, row.measured) == (each.rule, each.jobs, True)
        assert row.held == pytest.approx(each.held)
        assert row.worked == pytest.approx(each.worked)
        assert row.size == pytest.approx(each.size)
        assert row.files == pytest.approx(each.files)


def test_shapes_and_candidates_scale(measured):
    jobs = [job(rule, shard) for rule in SECONDS for shard in range(3)]
    plan = estimate(jobs, extent(12, "skeleton.candidates.count=5000"), measured)
    reconstruct, watertight, udf = plan.rows
    assert reconstruct.held == pytest.approx(2 * 4 * SECONDS["reconstruct"])
    assert watertight.held == pytest.approx(2 * 4 * SECONDS["watertight"])
    assert udf.held == pytest.approx(2 * 5 * 4 * SECONDS["udf"])
    assert plan.seconds[0] == pytest.approx((reconstruct.held / 3 / 4, reconstruct.worked / 3 / 4))


def test_what_is_removed_takes_no_place(measured):
    [kept] = estimate([job("udf", 0)], extent(SHAPES), measured).rows
    [removed] = estimate([job("udf", 0)], extent(SHAPES, "keep_intermediates=false"), measured).rows
    assert (removed.size, removed.files) == (0, 0)
    assert removed.removed == pytest.approx(kept.size)


@pytest.mark.parametrize(
    ("planned", "overrides", "reason"),
    [
        (job("reconstruct", 0, "ponq"), (), "not measured"),
        (job("dilation", 0), (), "not measured"),
        (job("reconstruct", 0), ("surface.poisson.depth=6",), r"measured with other settings only (small)"),
        (Job("html_report", {}, 1, 0, (), ("report",)), (), "no measure of its cost"),
    ],
)
def test_nothing_is_guessed(planned, overrides, reason, measured):
    plan = estimate([planned], extent(SHAPES, *overrides), measured)
    [row] = plan.rows
    assert (row.measured, row.basis, row.held, row.size) == (False, reason, 0, None)
    assert plan.seconds == [(0, 0)]


def test_the_first_run_that_fits_counts(measured):
    second = [dataclasses.replace(each, held=each.held * 9, source="second") for each in measured]
    [row] = estimate([job("udf", 0)], extent(SHAPES), [*measured, *second]).rows
    assert row.basis.startswith("small: ")
