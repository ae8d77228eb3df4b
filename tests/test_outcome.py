from morphoskel.run_progress.outcome import MOST_FAILURES, Job, describe_failures, describe_results


def made(*outputs):
    return Job("rule", outputs=outputs)


def test_a_job_is_named_by_its_rule_and_wildcards():
    assert str(Job("udf", ("test", "poisson", "00000"))) == "udf (test, poisson, 00000)"
    assert str(Job("all")) == "all"


def test_report_tables_and_figures_are_found_among_the_outputs():
    lines = describe_results(
        [
            made("results/demo/tables/b.csv", "results/demo/tables/b.tex", "results/demo/tables/b.md"),
            made("results/demo/tables/a.csv"),
            made("results/demo/figures/residue.png"),
            made("results/demo/figures/residue.pdf"),
            made("results/demo/figures/spheres.png"),
            made("results/demo/report/index.html", "results/demo/report/provenance.json"),
            made("results/demo/skeletons/synthetic/test/poisson/ms3d/00000"),
            made("resources/manifest/synthetic.csv"),
        ]
    )
    assert lines == [
        "report  results/demo/report/index.html",
        "table   results/demo/tables/a.csv",
        "table   results/demo/tables/b.{csv,md,tex}",
        "figures results/demo/figures/ (2)",
    ]


def test_where_nothing_to_look_at_was_made_nothing_is_said():
    assert describe_results([made("resources/manifest/synthetic.csv"), Job("all")]) == []


def test_failures_name_logs_and_the_way_on():
    failed = [Job("udf", ("00001",), logs=("results/demo/logs/udf/00001.log",)), Job("table")]
    assert describe_failures(failed, 34, 169, "morphoskel run skeleton.k=30") == [
        "34 of 169 jobs are done, 2 failed:",
        "  udf (00001): results/demo/logs/udf/00001.log",
        "  table: no log",
        "`morphoskel run skeleton.k=30` goes on where this run stopped; what is finished is kept.",
    ]


def test_a_run_that_was_stopped_goes_on_with_the_same_command():
    assert describe_failures([], 3, 5, "") == [
        "3 of 5 jobs are done.",
        "The same command goes on where this run stopped; what is finished is kept.",
    ]


def test_a_whole_run_has_no_failures():
    assert describe_failures([], 5, 5, "morphoskel run") == []


def test_many_failures_are_counted():
    lines = describe_failures([Job("udf")] * (MOST_FAILURES + 7), 0, 99, "")
    assert len(lines) == MOST_FAILURES + 3
    assert "  and 7 more" in lines
