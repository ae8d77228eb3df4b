import pytest
from solids import ball, box

from morphoskel.errors import InputError, ShapeError
from morphoskel.evaluation import scaling
from morphoskel.evaluation.scaling import SCALED_STAGES, SCALING_COLUMNS, measure_scaling, read_scaling, write_scaling
from morphoskel.shapes import Mesh

OPTIONS = {"k": 5, "seed": 1, "threads": 1}
HEADER = ",".join(SCALING_COLUMNS)


def test_every_number_repetition_and_stage_has_a_time():
    frame = measure_scaling(ball(subdivisions=2), [3000, 1000], repeats=2, **OPTIONS)
    assert tuple(frame.columns) == SCALING_COLUMNS
    assert [tuple(row) for row in frame[["repeat", "candidates", "stage"]].itertuples(index=False)] == [
        (repeat, count, stage) for repeat in (0, 1) for count in (1000, 3000) for stage in SCALED_STAGES
    ]
    assert (frame["seconds"] > 0).all()
    assert (frame["threads"] == 1).all()


def test_the_share_inside_is_that_of_the_volume():
    frame = measure_scaling(box(1, 1, 1), [500], repeats=1, **OPTIONS)
    assert (frame["inside"] >= 490).all()
    frame = measure_scaling(ball(subdivisions=3), [20000], repeats=1, **OPTIONS)
    assert frame["inside"].iloc[0] / 20000 == pytest.approx(0.5236, abs=0.02)


def test_the_warm_up_is_dropped_and_repetitions_differ(monkeypatch):
    counts = []
    original = scaling.occupancy
    monkeypatch.setattr(
        scaling, "occupancy", lambda mesh, box, threads: counts.append(len(box)) or original(mesh, box, threads=threads)
    )
    frame = measure_scaling(ball(subdivisions=2), [2000, 1000], repeats=3, **OPTIONS)
    assert counts == [1000, *3 * [1000, 2000]]
    assert len(frame) == 6 * len(SCALED_STAGES)
    assert frame.loc[frame["candidates"] == 2000, "inside"].nunique() > 1


def test_what_was_written_is_read_back(tmp_path):
    write_scaling(ball(subdivisions=2), tmp_path / "times.csv", [1000, 2000], repeats=1, **OPTIONS)
    frame = read_scaling(tmp_path / "times.csv")
    assert frame["candidates"].unique().tolist() == [1000, 2000]
    assert set(frame["stage"]) == set(SCALED_STAGES)


@pytest.mark.parametrize(
    ("counts", "repeats", "message"),
    [
        ([], 1, r"counts: .*got \[\]"),
        ([0, 10], 1, "each at least 1"),
        ([10, 10], 1, "different numbers"),
        ([10], 0, "repeats: expected at least 1, got 0"),
    ],
)
def test_nothing_to_measure_is_refused(counts, repeats, message):
    with pytest.raises(InputError, match=message):
        measure_scaling(ball(subdivisions=2), counts, repeats=repeats, **OPTIONS)


def test_an_open_surface_is_refused():
    solid = ball(subdivisions=2)
    with pytest.raises(ShapeError):
        measure_scaling(Mesh(solid.vertices, solid.triangles[1:]), [100], repeats=1, **OPTIONS)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "no such file; expected a table"),
        ("a,b\n1,2\n", "expected the columns candidates, .*, got a, b"),
        (HEADER + "\n", "at least one measurement"),
        (HEADER + "\n10,0,udf,1.0,5,1\n10,0,nap,1.0,5,1\n", "line 3: unknown stage"),
        (HEADER + "\n10,0,udf,0.0,5,1\n", "line 2: expected a positive number of seconds"),
        (HEADER + "\n0,0,udf,1.0,5,1\n", "line 2: expected at least one candidate"),
        (HEADER + "\n" + 2 * "10,0,udf,1.0,5,1\n", "line 3: a second time"),
    ],
)
def test_illegal_files_are_refused(tmp_path, content, message):
    if content is not None:
        (tmp_path / "times.csv").write_text(content)
    with pytest.raises(InputError, match=message):
        read_scaling(tmp_path / "times.csv")
