from solids import sphere_cloud
from tiny_point2skeleton import TINY

from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.formats import write_cloud_ply
from morphoskel.learning.point2skeleton_training import train_on_split
from morphoskel.networks.point2skeleton_network import load_point2skeleton


def test_training_on_a_split_writes_one_network(tmp_path):
    for split in ("train", "test"):
        for number in range(2):
            write_cloud_ply(tmp_path / "data" / "ball" / split / f"{split}{number}.ply", sphere_cloud(150, seed=number))
    section = compose(["dataset=class_tree", f"dataset.root={tmp_path}/data"]).model_dump(mode="json")["dataset"]
    write_manifest(
        tmp_path / "manifest.csv", build_manifest(open_configured(section, seed=1).list_shapes(), shard_size=4)
    )
    settings = {name: list(value) if isinstance(value, tuple) else value for name, value in TINY.as_mapping().items()}
    for name in ("first", "second"):
        train_on_split(
            tmp_path / "manifest.csv", tmp_path / f"{name}.pt", tmp_path / name, dataset=section, seed=3,
            network=settings, validation_share=0.5, accelerator="cpu",
        )  # fmt: skip
    assert (tmp_path / "first.pt").read_bytes() == (tmp_path / "second.pt").read_bytes()
    assert load_point2skeleton(tmp_path / "first.pt").settings == TINY
