import pytest

from morphoskel.run_progress.time_left import TimeLeft


def test_jobs_left_take_what_their_rule_took_so_far():
    left = TimeLeft({"udf": 4})
    left.start(1, "udf", 0.0)
    assert left.finish(1, 10.0) == 10.0
    assert left.seconds(10.0) == pytest.approx(30.0)


def test_nothing_is_guessed_before_half_of_the_jobs_are_known():
    left = TimeLeft({"config": 1, "train": 2, "udf": 3})
    assert left.seconds(0.0) is None
    left.start(1, "config", 0.0)
    left.finish(1, 1.0)
    assert left.seconds(1.0) is None
    left.start(2, "udf", 1.0)
    left.finish(2, 3.0)  # known are the two others, unknown the two trainings
    assert left.seconds(3.0) is not None


def test_unknown_rules_count_as_the_mean_of_the_known_ones():
    left = TimeLeft({"train": 1, "udf": 2, "dilation": 1}, {"udf": 10.0, "dilation": 40.0})
    assert left.seconds(0.0) == pytest.approx(25.0 + 2 * 10.0 + 40.0)


def test_rules_of_the_same_kind_stand_in_for_each_other():
    left = TimeLeft({"figure_residue": 3}, {"figure_spheres": 4.0, "train_sampler": 1000.0})
    assert left.seconds(0.0) == pytest.approx(12.0)


def test_this_run_says_more_than_earlier_ones():
    left = TimeLeft({"udf": 3}, {"udf": 500.0})
    left.start(1, "udf", 0.0)
    left.finish(1, 2.0)
    assert left.seconds(2.0) == pytest.approx(4.0)


def test_jobs_side_by_side_share_the_time():
    left = TimeLeft({"udf": 12})
    for job in range(4):
        left.start(job, "udf", 0.0)
    for job in range(4):
        left.finish(job, 10.0)
    assert left.seconds(10.0) == pytest.approx(8 * 10.0 / 4)


def test_the_longest_job_bounds_the_time_from_below():
    left = TimeLeft({"udf": 4, "train": 1}, {"train": 100.0, "udf": 1.0})
    for job in range(4):
        left.start(job, "udf", 0.0)
    for job in range(4):
        left.finish(job, 1.0)
    assert left.seconds(1.0) == pytest.approx(100.0)


def test_time_that_running_jobs_have_spent_is_not_left():
    left = TimeLeft({"train": 1}, {"train": 100.0})
    left.start(1, "train", 0.0)
    assert left.seconds(60.0) == pytest.approx(40.0)
    assert left.seconds(160.0) == 0.0  # longer than ever, but never negative


def test_a_failed_job_says_nothing_on_its_rule():
    left = TimeLeft({"udf": 3})
    left.start(1, "udf", 0.0)
    left.finish(1, 1.0, failed=True)
    assert left.seconds(1.0) is None


def test_nothing_left_takes_no_time():
    left = TimeLeft({"udf": 1})
    left.start(1, "udf", 0.0)
    left.finish(1, 1.0)
    assert left.seconds(1.0) == 0.0


def test_what_is_learned_late_counts():
    left = TimeLeft({"udf": 2})
    left.learn({"udf": 5.0})
    assert left.seconds(0.0) == pytest.approx(10.0)


def test_a_reference_is_scaled_by_what_this_run_took_for_the_same():
    left = TimeLeft({"udf": 2, "train": 1}, reference={"udf": 2.0, "train": 30.0})
    assert left.seconds(0.0) == pytest.approx(34.0)
    left.start(1, "udf", 0.0)
    left.finish(1, 6.0)
    assert left.seconds(6.0) == pytest.approx(6.0 + 3 * 30.0)


def test_an_earlier_run_says_more_than_the_reference():
    left = TimeLeft({"train": 1})
    left.learn({"train": 7.0}, {"train": 30.0})
    assert left.seconds(0.0) == pytest.approx(7.0)
