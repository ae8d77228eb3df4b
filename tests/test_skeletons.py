import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.chain.status import Status, write_status
from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.errors import ShapeError
from morphoskel.evaluation.skeletons import check_failures, evaluate_skeletons
from morphoskel.formats import write_cloud_ply, write_skeleton_ply
from morphoskel.shapes import Skeleton


@pytest.fixture
def evaluated(tmp_path):
    """Two shapes in two shards: a unit sphere explained by one ball of radius 0.5, and one that failed."""
    for name in "ab":
        write_cloud_ply(tmp_path / "clouds" / f"{name}.ply", sphere_cloud(100))
    section = compose(["dataset=folder", f"dataset.root={tmp_path}/clouds"]).model_dump(mode="json")["dataset"]
    records = build_manifest(open_configured(section, seed=1).list_shapes(), shard_size=1)
    write_manifest(tmp_path / "manifest.csv", records)
    folders = [tmp_path / "00000", tmp_path / "00001"]
    for folder, record, reason in zip(folders, records, ["", "no surface"], strict=True):
        folder.mkdir()
        state = "failed" if reason else "ok"
        write_status(folder, [Status(record.id, record.category, state, "reconstruct", reason, 1, 0.1, 0.1, "")])
    write_skeleton_ply(folders[0] / f"{records[0].id}.ply", Skeleton(np.zeros((1, 3)), [0.5], [0.0]))
    arguments = {"split": records[0].split, "dataset": section, "seed": 1, "surface": "poisson"}
    return tmp_path / "manifest.csv", folders, arguments


def test_every_shape_has_a_row_with_its_distances_or_its_reason(evaluated):
    manifest, folders, arguments = evaluated
    rows = evaluate_skeletons(manifest, folders, **arguments)
    assert rows["status"].tolist() == ["ok", "failed"]
    assert rows["reason"].tolist() == ["", "reconstruct: no surface"]
    good, bad = rows.iloc[0], rows.iloc[1]
    assert (good["surface_points"], good["spheres"]) == (100, 1)
    assert good["point_to_sphere_sum"] == pytest.approx(50, rel=1e-5)
    assert good["sphere_to_point_max"] == pytest.approx(0.5, rel=1e-5)
    assert np.isnan(bad["point_to_sphere_sum"])


def test_a_missing_shard_is_an_error(evaluated):
    manifest, folders, arguments = evaluated
    with pytest.raises(ShapeError, match=r"1 shapes of split .* have no skeleton"):
        evaluate_skeletons(manifest, folders[:1], **arguments)


def test_failures_are_tolerated_up_to_the_limit_and_named_beyond_it():
    rows = [{"id": f"s{number}", "status": "failed", "reason": "udf: boom"} for number in range(25)]
    check_failures([*rows, {"id": "good", "status": "ok", "reason": ""}], 25)
    with pytest.raises(ShapeError, match=r"(?s)25 shapes failed, 24 are tolerated.*s0: udf: boom.*and 5 more"):
        check_failures(rows, 24)
