import pytest

from morphoskel.planning.jobs import Job
from morphoskel.planning.schedule import wall_seconds


def job(name, *needs):
    return Job(name, {}, 1, 0, needs, (name,))


CHAINS = [job("a1"), job("a2", "a1"), job("b1"), job("b2", "b1"), job("table", "a2", "b2")]


@pytest.mark.parametrize(("at_once", "wall"), [(1, 9.0), (2, 5.0), (99, 5.0)])
def test_chains_run_side_by_side_and_the_table_waits(at_once, wall):
    assert wall_seconds(CHAINS, [2.0, 2.0, 1.0, 3.0, 1.0], at_once=at_once) == wall


def test_the_order_of_the_plan_does_not_matter_for_what_waits():
    assert wall_seconds(CHAINS[::-1], [1.0, 3.0, 1.0, 2.0, 2.0], at_once=9) == 5.0


def test_files_that_nobody_makes_are_there():
    assert wall_seconds([job("a", "data/cloud.ply")], [4.0], at_once=1) == 4.0


def test_no_jobs_take_no_time():
    assert wall_seconds([], [], at_once=3) == 0.0
