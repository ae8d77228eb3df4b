"""A shard as the workflow runs it: six stages, files in between."""

import numpy as np
import pytest
from small_chain import SEED, list_clouds, run_chain, run_stage, small_sections, write_clouds
from solids import sphere_cloud

from morphoskel.chain import shard
from morphoskel.chain.status import read_status
from morphoskel.datasets.configured import open_configured
from morphoskel.formats import read_skeleton_ply, write_cloud_ply
from morphoskel.skeletonization import skeletonize_shape
from morphoskel.stages import STAGES


@pytest.fixture(scope="module")
def sections(tmp_path_factory):
    root = tmp_path_factory.mktemp("clouds")
    write_clouds(root, 4)
    return small_sections(root)


@pytest.fixture(scope="module")
def reference(tmp_path_factory, sections):
    folder = tmp_path_factory.mktemp("reference")
    return folder, run_chain(folder, sections, shard_size=8, workers=1)


@pytest.mark.parametrize(("shard_size", "workers", "threads"), [(1, 1, 1), (3, 2, 1), (8, 4, 2)])
def test_skeletons_do_not_depend_on_shards_cores_or_threads(
    tmp_path, sections, reference, shard_size, workers, threads
):
    assert len(reference[1]) == 4
    assert run_chain(tmp_path, sections, shard_size, workers, threads) == reference[1]


def test_chain_equals_the_call_in_one_process(sections, reference):
    dataset = open_configured(sections["dataset"], seed=SEED)
    entry = sorted(dataset.list_shapes(), key=lambda entry: entry.id)[2]
    skeleton = skeletonize_shape(
        dataset.load(entry.path),
        reconstruction=sections["surface"]["poisson"],
        watertight_settings=sections["watertight"],
        candidates=sections["skeleton"]["candidates"],
        k=sections["skeleton"]["k"],
        points=sections["skeleton"]["points"],
        seed=SEED,
        name=entry.id,
    ).skeleton
    stored = read_skeleton_ply(reference[0] / "select_skeleton" / "0" / f"{entry.id}.ply")
    assert np.array_equal(skeleton.points, stored.points)
    assert np.array_equal(skeleton.radii, stored.radii)
    assert np.array_equal(skeleton.residues, stored.residues)


def test_intermediates_are_compact(reference):
    """At most 16 bytes an inner point, and a bit a candidate."""
    status = {row.id: dict(item.split("=") for item in row.details.split(";"))
              for row in read_status(reference[0] / "occupancy" / "0")}  # fmt: skip
    for shape, details in status.items():
        sizes = [(reference[0] / stage / "0" / f"{shape}.npy").stat().st_size for stage in ("udf", "dilation")]
        assert sum(sizes) <= 16 * int(details["inside"])
        assert (reference[0] / "occupancy" / "0" / f"{shape}.npz").stat().st_size < 5000 / 8 + 2500


def test_the_seconds_of_all_stages_add_up(reference):
    """Each stage adds its own to those of the stages before it, once, though a stage may read several of them."""
    folder = reference[0]
    rows = {stage: {row.id: row for row in read_status(folder / stage / "0")} for stage in STAGES}
    assert len(rows["reconstruct"]) == 4
    for shape in rows["reconstruct"]:
        total = 0.0
        for stage in STAGES:
            total += rows[stage][shape].seconds
            assert rows[stage][shape].seconds_so_far == pytest.approx(total, abs=0.001 * len(STAGES))
        assert total > 0.01


def test_a_failing_shape_is_recorded_and_carried_on(tmp_path, sections):
    broken = dict(sections, skeleton={**sections["skeleton"], "k": "many"})
    run_chain(tmp_path, broken, shard_size=8, workers=2)
    rows = read_status(tmp_path / "select_skeleton" / "0")
    assert {row.status for row in rows} == {"failed"}
    assert {(row.stage, row.attempts) for row in rows} == {("dilation", 2)}
    assert all("TypeError" in row.reason for row in rows)
    assert rows == read_status(tmp_path / "dilation" / "0")  # carried on as they were, with the seconds until then
    assert all(row.seconds_so_far > row.seconds for row in rows)
    assert not list((tmp_path / "select_skeleton" / "0").glob("*.ply"))


def _write_half_and_fail(stage, task):
    task.write(".ply").write_bytes(b"half")
    task.write(".ply.partial").write_bytes(b"half")
    if task.record.id == "shape1":
        raise ValueError("no surface")
    task.write(".ply.partial").unlink()
    return {}


def test_a_failed_shape_leaves_no_half_written_file(tmp_path, sections, monkeypatch):
    monkeypatch.setattr(shard, "_run_stage", _write_half_and_fail)
    list_clouds(tmp_path, sections, shard_size=8)
    run_stage(tmp_path, sections, "reconstruct")
    names = {path.name for path in (tmp_path / "reconstruct" / "0").iterdir()}
    assert names == {"SHA256SUMS", "status.csv", "shape0.ply", "shape2.ply", "shape3.ply"}


def test_one_broken_file_loses_only_itself(tmp_path, sections):
    root = tmp_path / "clouds"
    root.mkdir()
    for number in range(3):
        write_cloud_ply(root / f"shape{number}.ply", sphere_cloud(400, seed=number))
    (root / "shape1.ply").write_bytes((root / "shape1.ply").read_bytes()[:-100])
    altered = dict(sections, dataset={**sections["dataset"], "root": str(root)})
    skeletons = run_chain(tmp_path, altered, shard_size=8, workers=2)
    assert len(skeletons) == 2
    [failed] = [row for row in read_status(tmp_path / "select_skeleton" / "0") if row.status == "failed"]
    assert failed.stage == "reconstruct"
    assert "shape1.ply" in failed.reason
