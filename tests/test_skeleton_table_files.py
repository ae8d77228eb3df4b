import pandas as pd
import pytest
from conftest import REPOSITORY

from morphoskel.errors import InputError
from morphoskel.reporting.skeleton_table_files import TITLES, write_skeleton_table
from morphoskel.stages import TIMED_STAGES

PROVENANCE = {"dataset": "mine", "seed": 7, "protocol": "correct", "candidates": "1,000 random",
              "medial_axis": "computed", "config": "abc123"}  # fmt: skip
DISTANCES = {"surface_points": 100, "spheres": 50, "point_to_sphere_sum": 2.0, "point_to_sphere_max": 0.1,
             "sphere_to_point_sum": 1.0, "sphere_to_point_max": 0.3}  # fmt: skip


def rows_of(name, surface):
    shape = {"id": "a", "category": "Chair", "surface": surface}
    if name == "processing_time":
        return pd.DataFrame([{**shape, "stage": stage, "seconds": 0.25, "threads": 2} for stage in TIMED_STAGES])
    return pd.DataFrame([{**shape, "method": "ms3d", "balls": "as is", "status": "ok", "reason": "", **DISTANCES}])


@pytest.mark.parametrize("name", TITLES)
def test_tables_hold_the_computed_and_the_published_values(name, tmp_path):
    paths = []
    for surface in ("poisson", "ball_pivoting"):
        paths.append(tmp_path / f"{surface}.csv")
        rows_of(name, surface).to_csv(paths[-1], index=False)
    write_skeleton_table(name, paths, REPOSITORY / "config" / "paper", tmp_path / "table", PROVENANCE)
    frame = pd.read_csv(tmp_path / "table.csv", keep_default_na=False)
    method, metric, value = {
        "skeleton_reconstruction": ("MS3D", "cd_recon", 0.04),
        "surface_reconstruction": ("BPA", "hd_recon", 0.3),
        "processing_time": ("MS3D", "seconds", 1.0),
    }[name]
    [cell] = frame[(frame["method"] == method) & (frame["metric"] == metric) & (frame["group"] == "Chair")].to_dict(
        "records"
    )
    assert float(cell["value"]) == pytest.approx(value)
    assert float(cell["paper"]) > 0
    text = (tmp_path / "table.md").read_text()
    for word in ("mine", "n = 1", "seeds 7", "correct", "1,000 random", "abc123"):
        assert word in text


def test_categories_that_the_paper_lacks_come_before_the_averages(tmp_path):
    rows_of("surface_reconstruction", "poisson").assign(category="bed").to_csv(tmp_path / "rows.csv", index=False)
    published = REPOSITORY / "config" / "paper"
    write_skeleton_table("surface_reconstruction", [tmp_path / "rows.csv"], published, tmp_path / "table", PROVENANCE)
    header = next(line for line in (tmp_path / "table.md").read_text().splitlines() if line.startswith("| Method"))
    assert header.index("Rifle") < header.index("bed") < header.index("Mean over")


def test_an_unknown_table_is_refused(tmp_path):
    with pytest.raises(InputError, match="legal are skeleton_reconstruction"):
        write_skeleton_table("nothing", [], tmp_path, tmp_path / "table", PROVENANCE)
