import os

import pytest
from measured_run import write_measured_run

from morphoskel.config import compose
from morphoskel.errors import InputError
from morphoskel.planning.plan import REFERENCE, default_measurements, planned_extent


def test_the_newest_run_with_a_table_counts(tmp_path):
    for age, name in enumerate(("newest", "older", "smoke")):
        run = write_measured_run(tmp_path / "results" / name)
        os.utime(run / "tables" / "skeleton_reconstruction.csv", (1000 - age, 1000 - age))
    os.utime(tmp_path / "results" / "smoke" / "tables" / "skeleton_reconstruction.csv")
    (tmp_path / "results" / "unfinished").mkdir()
    (tmp_path / "results" / "unfinished" / "config.yaml").write_text("")
    assert default_measurements(tmp_path) == tmp_path / "results" / "newest"


def test_without_a_run_the_measurements_of_the_repository_count(tmp_path):
    with pytest.raises(InputError, match="no finished run to take times from"):
        default_measurements(tmp_path)
    (tmp_path / REFERENCE).parent.mkdir(parents=True)
    (tmp_path / REFERENCE).write_text("")
    assert default_measurements(tmp_path) == tmp_path / REFERENCE


def test_absent_data_are_as_many_as_were_published(tmp_path):
    extent = planned_extent(compose(["experiment=paper"]), tmp_path)
    assert extent.counts == {"point2skeleton": {"train": 5904, "test": 1184}}
