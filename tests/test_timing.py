import pytest
from solids import sphere_cloud

from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.evaluation import timing
from morphoskel.evaluation.timing import time_stages
from morphoskel.formats import write_cloud_ply
from morphoskel.stages import TIMED_STAGES


@pytest.fixture
def timed(tmp_path):
    for number in range(3):
        write_cloud_ply(tmp_path / "clouds" / "Ball" / f"{number}.ply", sphere_cloud(300, seed=number))
    overrides = ["experiment=smoke", "dataset=folder", f"dataset.root={tmp_path}/clouds", "surface.poisson.depth=5",
                 "skeleton.candidates.count=2000"]  # fmt: skip
    sections = compose(overrides).model_dump(mode="json")
    records = build_manifest(open_configured(sections["dataset"], seed=1).list_shapes(), shard_size=8)
    write_manifest(tmp_path / "manifest.csv", records)
    sections["reconstruction"] = sections["surface"]["poisson"]
    return tmp_path / "manifest.csv", {"split": records[0].split, "sections": sections, "seed": 1, "threads": 1}


def test_chosen_shapes_have_every_stage_and_the_warm_up_is_dropped(timed, monkeypatch):
    manifest, arguments = timed
    reconstructions = []
    original = timing.reconstruct
    monkeypatch.setattr(timing, "reconstruct", lambda *a, **b: reconstructions.append(1) or original(*a, **b))
    rows = time_stages(manifest, surface="poisson", shapes_per_category=2, **arguments)
    assert len(reconstructions) == 3
    assert rows["id"].nunique() == 2
    assert rows["stage"].tolist() == [*TIMED_STAGES, *TIMED_STAGES]
    assert (rows["seconds"] > 0).all()


def test_a_stage_that_fails_leaves_an_empty_time(timed):
    manifest, arguments = timed
    arguments["sections"]["reconstruction"] = {"alpha": 1e-6}
    rows = time_stages(manifest, surface="alpha_shape", shapes_per_category=1, **arguments)
    assert rows["seconds"].isna().all()
