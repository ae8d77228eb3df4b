"""Part segmentation on extracts of ShapeNetPart in both layouts, from files to the table."""

import json

import numpy as np
import pandas as pd
import pytest
from conftest import REPOSITORY
from tiny_parts import TINY

from morphoskel.config import compose
from morphoskel.datasets.cloud_set import gather_clouds, read_cloud_set, write_cloud_set
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.datasets.shapenetpart import PARTS, SPLIT_LISTS
from morphoskel.evaluation.segmentation import evaluate_segmentation_files
from morphoskel.learning.segmentation_training import train_segmentation_on_files
from morphoskel.reporting.segmentation_table_files import write_segmentation_table
from morphoskel.sampling.choose_for_split import choose_for_split
from morphoskel.sampling.prior import PriorSettings

SPLITS = {"train": slice(0, None, 2), "val": slice(1, None, 4), "test": slice(3, None, 4)}
FOLDERS = {"shapenetpart_raw": "0*/points/*.pts", "shapenetpart_normal": "0*/*.txt"}
PROVENANCE = {
    "dataset": "shapenetpart", "seed": 3, "seeds": 1, "protocol": "correct", "config": "abc", "budget": "2 epochs",
    "decisions": [], "transferred_from": "shapenetpart",
}  # fmt: skip


@pytest.fixture(params=FOLDERS)
def root(request, real_data, tmp_path):
    """A folder of links to the extract, with lists that split it."""
    source = real_data / request.param
    files = sorted(source.glob(FOLDERS[request.param]))
    for folder in source.glob("0*"):
        (tmp_path / folder.name).symlink_to(folder)
    shapes = [f"shape_data/{path.relative_to(source).parts[0]}/{path.stem}" for path in files]
    for split, part in SPLITS.items():
        path = tmp_path / SPLIT_LISTS[split]
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(shapes[part]))
    return tmp_path


def test_it_is_trained_and_evaluated(root, tmp_path):
    section = compose(["dataset=shapenetpart", f"dataset.root={root}"]).model_dump(mode="json")["dataset"]
    manifest = tmp_path / "manifest.csv"
    write_manifest(manifest, build_manifest(open_configured(section, seed=3).list_shapes(), shard_size=64))
    clouds = {split: tmp_path / f"{split}.npz" for split in SPLITS}
    samples = {split: tmp_path / "samples" / split for split in SPLITS}
    for split, path in clouds.items():
        gathered = gather_clouds(manifest, split, dataset=section, points=2048, seed=3, repeat=True, progress=False)
        write_cloud_set(gathered, path)
        choose_for_split(
            "fps", path, samples[split], networks=[], priors=None, ratios=[16, 128], draws=1, seed=3,
            prior=PriorSettings(6, 1.0).__dict__, lfs=None,
        )  # fmt: skip
    test = read_cloud_set(clouds["test"])
    for parts, category in zip(test.parts, test.categories, strict=True):
        assert set(parts.tolist()) <= set(PARTS[category])
    networks = {"fps": [16, 128], "full": [1]}
    rows = []
    for strategy, ratios in networks.items():
        chosen = [samples["train"]] if strategy == "fps" else []
        files = [tmp_path / "networks" / strategy / str(ratio) / "0" / "network.pt" for ratio in ratios]
        for ratio, file in zip(ratios, files, strict=True):
            train_segmentation_on_files(
                strategy, ratio, 0, [clouds["train"]], chosen, file, tmp_path / "checkpoints", seed=3,
                settings=TINY.as_mapping(), validation_clouds=clouds["val"],
                validation_samples=samples["val"] if chosen else None, validation_share=0.5,
                validation_labels="labelled", completed=False, label_sets=1, full_supervision={},
                accelerator="cpu",
            )  # fmt: skip
        rows.append(tmp_path / f"{strategy}.csv")
        evaluate_segmentation_files(
            strategy, clouds["test"], files, [clouds["train"]], chosen, rows[-1], completed=False, label_sets=1
        )
    frame = pd.concat(pd.read_csv(path, dtype={"ratio": str}) for path in rows)
    assert len(frame) == 3 * len(test)
    assert frame["iou"].between(0, 1).all()
    assert frame.groupby("ratio")["labels"].first().to_dict() == {"1": 2048, "16": 128, "128": 16}
    write_segmentation_table(rows, REPOSITORY / "config" / "paper", tmp_path / "table", PROVENANCE)
    cells = pd.read_csv(tmp_path / "table.csv")
    means = cells[(cells["metric"] == "miou") & (cells["group"] == "Mean over shapes")].set_index("method")["value"]
    assert float(means["FPS, ratio 16"]) == pytest.approx(100 * np.mean(frame[frame["ratio"] == "16"]["iou"]))
