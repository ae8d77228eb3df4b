from morphoskel.planning.estimate import Estimate, Row
from morphoskel.planning.jobs import Job
from morphoskel.planning.plan_table import plan_values, render_plan

ROWS = [
    Row("udf", "", "demo: 2 jobs, 6 shapes x candidates", "shapes x candidates", True, jobs=2, amount=4e6, held=7200.0,
        worked=3600.0, size=0.0, files=0.0, removed=3e9),
    Row("reconstruct", "poisson", "demo: 2 jobs, 6 shapes", "shapes", True, jobs=1, amount=12, held=1800.0,
        worked=900.0, size=2.5e6, files=14.0),
    Row("figure_one", "", "no measure of its cost", "", False, jobs=1),
    Row("figure_two", "", "no measure of its cost", "", False, jobs=1),
    Row("train_sampler", "snet", "measured with other settings only (demo)", "", False, jobs=1, gpu_jobs=1),
]  # fmt: skip
JOBS = [Job(f"job {number}", {}, 1, 0, (), (str(number),)) for number in range(6)]
PLAN = Estimate(ROWS, [(3600.0, 1800.0)] * 2 + [(1800.0, 900.0)] + [(0.0, 0.0)] * 3)
VALUES = plan_values(JOBS, PLAN, [1, 2])


def test_sums_leave_out_what_was_not_measured():
    assert VALUES["totals"] == {"jobs": 6, "jobs_measured": 3, "core_hours_held": 2.5, "core_hours_worked": 1.25,
                                "gpu_hours": None, "bytes": 2.5e6, "files": 14.0, "bytes_removed": 3e9}  # fmt: skip
    assert [(wall["at_once"], wall["held"], wall["worked"]) for wall in VALUES["wall_hours"]] == [
        (1, 2.5, 1.25),
        (2, 1.5, 0.75),
    ]
    assert [row["core_hours_held"] for row in VALUES["rows"]] == [2.0, 0.5, None, None, None]


def test_the_table_says_what_is_not_known():
    lines = render_plan(VALUES).splitlines()
    rows = {line.split("  ")[0]: line for line in lines if line}
    assert rows["reconstruct poisson"].endswith("2.5 MB     14  demo: 2 jobs, 6 shapes -> 12")
    assert rows["udf"].endswith("shapes x candidates -> 4e+06")
    assert rows["train_sampler snet"].split()[2:7] == ["1", "?", "?", "?", "?"]
    assert rows["figures"].split()[1] == "2"
    assert "6 jobs in all. 3 of them were not measured and are in no sum." in lines
    assert "Beside, 3.0 GB are written in all and removed as soon as they are read." in lines
