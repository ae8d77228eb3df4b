import pytest
from small_run import PROVENANCE

from morphoskel.reporting.page.configuration import Configuration
from morphoskel.reporting.page.provenance_rows import commit_text, date_text, provenance_rows

CONFIGURATION = Configuration({"seed": 7, "sampling": {"draws": 5}, "tasks": {"segmentation": None}}, "")


def test_rows_tell_date_commit_machine_and_seeds():
    rows = dict(provenance_rows(PROVENANCE, CONFIGURATION))
    assert rows["Date"] == "25 March 2025, 12:34 UTC"
    assert rows["Commit"] == PROVENANCE["commit"]
    assert rows["Processor"] == "Fast One, 2 cores in use"
    assert rows["Memory"] == "8.0 GiB"
    assert (rows["Seed of the run"], rows["Draws of each sampler with noise"]) == ("7", "5")
    assert not any("segmentation" in name or "Trainings" in name for name in rows)


def test_what_is_not_known_is_said_and_paths_are_masked():
    machine = {**PROVENANCE["machine"], "memory": None, "system": "built in /home/ada/linux"}
    rows = dict(provenance_rows({**PROVENANCE, "commit": None, "dirty": None, "machine": machine}, CONFIGURATION))
    assert rows["Memory"] == "unknown"
    assert rows["Commit"].startswith("unknown")
    assert rows["Operating system"] == "built in …/linux"


@pytest.mark.parametrize("date", ["2025-03-25T12:34:56+00:00", "2025-03-25T14:34:56+02:00"])
def test_dates_are_in_universal_time(date):
    assert date_text(date) == "25 March 2025, 12:34 UTC"


def test_edits_are_told():
    assert commit_text({**PROVENANCE, "dirty": True}, 6) == "012345, with edits that are not committed"
