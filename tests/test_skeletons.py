import numpy as np
import pytest
from solids import sphere_cloud

from morphoskel.chain.status import Status, write_status
from morphoskel.checksums import write_checksums
from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, read_manifest, write_manifest
from morphoskel.errors import ShapeError
from morphoskel.evaluation.skeletons import Balls, check_failures, evaluate_skeletons
from morphoskel.formats import write_cloud_ply, write_skeleton_ply
from morphoskel.shapes import Skeleton


def read_ids(manifest):
    return [record.id for record in read_manifest(manifest)]


@pytest.fixture
def evaluated(tmp_path):
    """Two shapes in two shards: a unit sphere explained by one ball of radius 0.5, and one that failed."""
    for name in "ab":
        write_cloud_ply(tmp_path / "clouds" / f"{name}.ply", sphere_cloud(100))
    section = compose(["dataset=folder", f"dataset.root={tmp_path}/clouds"]).model_dump(mode="json")["dataset"]
    records = build_manifest(open_configured(section, seed=1).list_shapes(), shard_size=1)
    write_manifest(tmp_path / "manifest.csv", records)
    folders = [tmp_path / "00000", tmp_path / "00001"]
    axes = [tmp_path / "axis"]
    write_skeleton_ply(folders[0] / f"{records[0].id}.ply", Skeleton(np.zeros((1, 3)), [0.5], [0.0]))
    for folder, record, reason in zip(folders, records, ["", "no surface"], strict=True):
        folder.mkdir(exist_ok=True)
        state = "failed" if reason else "ok"
        write_status(folder, [Status(record.id, record.category, state, "reconstruct", reason, 1, 0.1, 0.1, "")])
    for record in records:
        write_skeleton_ply(axes[0] / f"{record.id}.ply", Skeleton(np.array([[0, 0, 0.25], [0, 0, -0.5]]), [1.0, 1.0]))
    write_status(axes[0], [Status(r.id, r.category, "ok", "medial_axis", "", 1, 0.1, 0.1, "") for r in records])
    arguments = {"split": records[0].split, "dataset": section, "seed": 1, "surface": "poisson", "method": "ms3d"}
    return tmp_path / "manifest.csv", folders, axes, arguments


def test_every_shape_has_a_row_with_its_distances_or_its_reason(evaluated):
    manifest, folders, axes, arguments = evaluated
    rows = evaluate_skeletons(manifest, folders, axes, **arguments, balls=Balls())
    assert rows["status"].tolist() == ["ok", "failed"]
    assert rows["reason"].tolist() == ["", "reconstruct: no surface"]
    good, bad = rows.iloc[0], rows.iloc[1]
    assert (good["surface_points"], good["spheres"], good["seconds"]) == (100, 1, 0.1)
    assert good["point_to_sphere_sum"] == pytest.approx(50, rel=1e-5)
    assert good["sphere_to_point_max"] == pytest.approx(0.5, rel=1e-5)
    assert np.isnan(bad["point_to_sphere_sum"])


def test_distances_to_the_axis_take_no_radii(evaluated):
    manifest, folders, axes, arguments = evaluated
    good = evaluate_skeletons(manifest, folders, axes, **arguments, balls=Balls()).iloc[0]
    assert (good["axis_surface_points"], good["axis_spheres"]) == (2, 1)
    assert good["axis_point_to_sphere_sum"] == pytest.approx(0.75)
    assert good["axis_sphere_to_point_max"] == pytest.approx(0.25)
    without = evaluate_skeletons(manifest, folders, [], **arguments, balls=Balls())
    assert not any(column.startswith("axis_") for column in without)


def test_a_failed_axis_leaves_the_distances_to_the_cloud(evaluated):
    manifest, folders, axes, arguments = evaluated
    rows = [Status(name, "shape", "failed", "watertight", "boom", 2, 0.1, 0.1, "") for name in read_ids(manifest)]
    write_status(axes[0], rows)
    good = evaluate_skeletons(manifest, folders, axes, **arguments, balls=Balls()).iloc[0]
    assert (good["status"], good["reason"]) == ("ok", "reference axis: watertight: boom")
    assert good["point_to_sphere_sum"] > 0
    assert "axis_spheres" not in good


def test_equal_counts_and_dense_balls_are_rows_of_their_own(evaluated):
    manifest, folders, axes, arguments = evaluated
    first = read_ids(manifest)[0]
    curve = Skeleton(np.array([[0, 0, -0.5], [0, 0, 0.5]]), [0.5, 0.5], edges=[[0, 1]])
    write_skeleton_ply(folders[0] / f"{first}.ply", curve)
    write_checksums(folders[0])
    rows = evaluate_skeletons(manifest, folders, axes, **arguments, balls=Balls(equal_counts=(1, 7), dense=30))
    assert rows["balls"].tolist() == ["as is", "dense", "1", "7"] * 2
    assert rows["spheres"].tolist()[:4] == [2, 30, 1, 7]
    assert rows["seconds"].notna().tolist() == [True] + [False] * 7
    assert rows["status"].tolist()[4:] == ["failed"] * 4


def test_balls_that_cannot_be_made_up_have_a_reason(evaluated):
    manifest, folders, axes, arguments = evaluated
    rows = evaluate_skeletons(manifest, folders, axes, **arguments, balls=Balls(equal_counts=(5,)))
    assert rows["reason"].tolist()[1].startswith("equal count: has 1 balls")
    check_failures(rows.to_dict("records"), 1)  # only the shape without a skeleton counts


def test_a_missing_shard_is_an_error(evaluated):
    manifest, folders, axes, arguments = evaluated
    with pytest.raises(ShapeError, match=r"1 shapes are in none of 1 folders"):
        evaluate_skeletons(manifest, folders[:1], axes, **arguments, balls=Balls())


def test_failures_are_tolerated_up_to_the_limit_and_named_beyond_it():
    rows = [{"id": f"s{n}", "balls": "as is", "status": "failed", "reason": "udf: boom"} for n in range(25)]
    check_failures([*rows, {"id": "good", "balls": "as is", "status": "ok", "reason": ""}], 25)
    with pytest.raises(ShapeError, match=r"(?s)25 shapes failed, 24 are tolerated.*s0: udf: boom.*and 5 more"):
        check_failures(rows, 24)
