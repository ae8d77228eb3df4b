import dataclasses

from morphoskel.chain.status import Status, write_status
from morphoskel.reporting.page.failures import FailureGroup, Failures, collect_failures

OK = Status("a", "Chair", "ok", "udf", "", 1, 0.1, 0.2, "")


def broken(shape, stage="reconstruct", reason="boom"):
    return dataclasses.replace(OK, id=shape, status="failed", stage=stage, reason=reason, attempts=2)


def write(run, place, *rows):
    (run / place).mkdir(parents=True)
    write_status(run / place, rows)


def test_a_failure_that_is_carried_on_counts_once(tmp_path):
    for stage in ("surfaces", "watertight"):
        write(tmp_path, f"{stage}/set/test/poisson/00000", OK, broken("b"))
    write(tmp_path, "skeletons/set/test/poisson/ms3d/00000", OK, broken("b"))
    write(tmp_path, "medial_axis/set/test/00000", OK, broken("b"))
    assert collect_failures(tmp_path) == Failures(
        2, 1, 0, (FailureGroup("reconstruct", "boom", ("Poisson",), 1, ("b",)),)
    )


def test_shapes_are_grouped_by_stage_and_reason_whatever_the_numbers(tmp_path):
    rows = [broken(f"s{n}", reason=f"{n} of 9 points in /home/ada/s{n}.ply") for n in range(5)]
    write(tmp_path, "surfaces/set/test/poisson/00000", *rows)
    write(tmp_path, "surfaces/set/train/ponq/00000", broken("s0", reason="7 of 9 points in /home/ada/s7.ply"))
    write(tmp_path, "skeletons/set/test/cloud/dpc/00000", broken("s0", "dpc", "boom 3"))
    found = collect_failures(tmp_path)
    assert (found.shapes, found.failed) == (6, 6)
    assert found.groups == (
        FailureGroup("reconstruct", "… of 9 points in …/s….ply", ("Poisson", "PoNQ"), 6, ("s0", "s1", "s2")),
        FailureGroup("dpc", "boom 3", ("cloud",), 1, ("s0",)),
    )


def test_a_reason_with_an_ellipsis_of_its_own_is_no_number(tmp_path):
    write(tmp_path, "surfaces/set/test/poisson/00000", broken("a", reason="x … y"), broken("b", reason="x 3 y"))
    assert [group.reason for group in collect_failures(tmp_path).groups] == ["x 3 y", "x … y"]


def test_second_attempts_that_helped_are_counted(tmp_path):
    write(tmp_path, "udf/set/test/poisson/00000", dataclasses.replace(OK, attempts=2), dataclasses.replace(OK, id="b"))
    assert collect_failures(tmp_path) == Failures(2, 0, 1, ())


def test_what_is_still_being_written_is_left_aside(tmp_path):
    write(tmp_path, "udf/set/test/poisson/00000.partial", broken("a"))
    assert collect_failures(tmp_path) == Failures(0, 0, 0, ())
