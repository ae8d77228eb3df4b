"""The folder of a small run, shared by the tests of the report: two shapes, a third that failed, tables, a figure."""

import json

import numpy as np
import pandas as pd
import yaml
from PIL import Image
from solids import ball, box

from morphoskel.chain import dilation, occupancy, select_skeleton, udf
from morphoskel.chain.status import Status, write_status
from morphoskel.chain.task import Task
from morphoskel.datasets.cloud_set import CloudSet, normalise, write_cloud_set
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.formats import write_cloud_ply, write_mesh_ply
from morphoskel.reporting.page.embedded_figures import FigureSource
from morphoskel.reporting.page.run_scenes import SceneSources
from morphoskel.reporting.table import MEASURED_COLUMNS, assemble, write_table
from morphoskel.sampling.choice import DRAWN, FIXED, Choice, write_choice
from morphoskel.shapes import PointCloud

SURFACES = {"Ball": ball(subdivisions=2), "Box": box(1.0, 0.6, 0.4)}
FAILED = "Broken-b"
REASON = "ShapeError: /home/ada/data/broken.ply holds 4 points"
CANDIDATES = {"count": 4096, "mode": "random"}
CHAIN = {"occupancy": occupancy, "udf": udf, "dilation": dilation, "skeletons": select_skeleton}
PROVENANCE = {
    "date": "2025-03-25T12:34:56+00:00",
    "version": "0.1.0",
    "commit": "0123456789abcdef0123456789abcdef01234567",
    "dirty": False,
    "python": "3.11.7",
    "packages": {"numpy": "2.2.0"},
    "machine": {"system": "Linux", "processor": "Fast One", "cores": 2, "memory": 8 * 2**30},
}


def result_frame():
    """Values of three methods: printed and computed, computed only, not run, and failed; with intervals."""
    rows = [
        ("MS3D", "Chair", "cd_recon", 0.0123, 0.001, 3, 0), ("MS3D", MEAN_OVER_SHAPES, "cd_recon", 0.02, 0.01, 3, 1),
        ("DPC", "Chair", "cd_recon", 0.0312, 0.002, 3, 0), ("DPC", MEAN_OVER_SHAPES, "cd_recon", 0.011, 0.01, 4, 0),
        ("L1", MEAN_OVER_SHAPES, "cd_recon", np.nan, np.nan, 0, 4),
        ("MS3D", "8", "oa", 90.25, 1.0, 4, 0), ("MS3D", "8", "oa_interval", 3.5, np.nan, 4, 0),
        ("FPS", "8", "oa", 85.0, np.nan, 4, 0),
    ]  # fmt: skip
    printed = [
        ("L1", "Chair", "cd_recon", 0.1126), ("MS3D", "Chair", "cd_recon", 0.0296),
        ("MS3D", MEAN_OVER_SHAPES, "cd_recon", 0.0274), ("DPC", "Chair", "cd_mat", 0.1), ("MS3D", "8", "oa", 91.0),
    ]  # fmt: skip
    measured = pd.DataFrame(rows, columns=list(MEASURED_COLUMNS))
    published = pd.DataFrame(printed, columns=["method", "group", "metric", "value"])
    return assemble(measured, published, dataset="solids", seeds=[7], protocol="correct")


def ok(record, stage):
    return Status(record.id, record.category, "ok", stage, "", 1, 0.5, 1.0, "")


def failed(record):
    return Status(record.id, record.category, "failed", "reconstruct", REASON, 2, 0.1, 0.1, "")


def write_shapes(root, run):
    """Write clouds, manifest, surfaces, the stages of the chain and chosen points; return where scenes find them."""
    clouds = {name: PointCloud(mesh.vertices) for name, mesh in SURFACES.items()}
    for name, cloud in {**clouds, "Broken": PointCloud(np.eye(4)[:, :3])}.items():
        (root / "data" / name).mkdir(parents=True)
        write_cloud_ply(root / "data" / name / "b.ply", cloud)
    section = {"kind": "folder", "root": str(root / "data"), "name": "solids"}
    records = build_manifest(open_configured(section, seed=7).list_shapes(), shard_size=8)
    write_manifest(root / "solids.csv", records)
    folders = {kind: run / kind / "solids" / "test" / "poisson" / "00000" for kind in ("watertight", *CHAIN)}
    folders["skeletons"] = run / "skeletons/solids/test/poisson/ms3d/00000"
    for kind, folder in folders.items():
        folder.mkdir(parents=True)
        for record in records:
            if record.id == FAILED:
                continue
            if kind == "watertight":
                write_mesh_ply(folder / f"{record.id}.ply", SURFACES[record.category])
            else:
                settings = {"candidates": CANDIDATES, "k": 8, "points": 32}
                CHAIN[kind].run(Task(record, folders, folder, settings, seed=3))
        write_status(folder, [failed(record) if record.id == FAILED else ok(record, kind) for record in records])
    write_chosen(run, {record.id: clouds[record.category] for record in records if record.id != FAILED})
    return SceneSources(
        manifest=root / "solids.csv",
        split="test",
        dataset=section,
        seed=7,
        watertight=[folders["watertight"]],
        skeletons=[folders["skeletons"]],
        inner={stage: [folders[stage]] for stage in ("occupancy", "udf", "dilation")},
        candidates=CANDIDATES,
        clouds=run / "clouds.npz",
        samples={"MS3D": run / "samples/ms3d", "FPS": run / "samples/fps"},
        ratio=2,
    )


def write_chosen(run, clouds):
    """Write eight points of each cloud, and four of them that two samplers chose; one draws a point twice."""
    normalised = [normalise(cloud.points[:8]) for cloud in clouds.values()]
    points, centres, scales = (np.stack(each) for each in zip(*normalised, strict=True))
    ids, names = np.array(list(clouds)), np.array(sorted(SURFACES))
    write_cloud_set(CloudSet(ids, np.arange(len(ids)), names, points, centres, scales), run / "clouds.npz")
    for sampler, kind, chosen in (("ms3d", DRAWN, [0, 2, 2, 7]), ("fps", FIXED, [1, 3, 5, 7])):
        indices = np.array([[chosen] * len(ids)], dtype=np.int32)
        (run / "samples" / sampler).mkdir(parents=True)
        distinct = np.full((1, len(ids)), len(set(chosen)), dtype=np.int32)
        write_choice(Choice(indices, distinct), run / "samples" / sampler / f"2_0_{kind}.npz")


def write_small_run(root):
    """Write everything, and return the arguments of ``write_report`` but for the path."""
    run = root / "results" / "small"
    scenes = write_shapes(root, run)
    frame = result_frame()
    of_skeletons = frame[frame["metric"].isin(["cd_recon", "cd_mat"])].reset_index(drop=True)
    of_samplers = frame[frame["metric"].isin(["oa", "oa_interval"])].reset_index(drop=True)
    for name, part in (("skeleton_reconstruction", of_skeletons), ("object_classification", of_samplers)):
        write_table(part, run / "tables" / name, f"Caption of {name}, 5 * <b>", ["First note.", "Second | note."])
    (run / "figures").mkdir()
    gradient = np.linspace(0, 255, 60 * 40 * 3).reshape(40, 60, 3).astype(np.uint8)
    Image.fromarray(gradient).save(run / "figures" / "gradient.png")
    config = {"run": "small", "seed": 7, "dataset": {"name": "solids", "root": str(root / "data")}}
    (run / "config.yaml").write_text(yaml.safe_dump(config, sort_keys=False))
    (run / "provenance.json").write_text(json.dumps(PROVENANCE))
    for name, seconds in (("watertight/solids/a", 61.0), ("watertight/solids/b", 3.0), ("train", 9.0)):
        path = run / "benchmarks" / f"{name}.tsv"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"s\th:m:s\tmax_rss\tcpu_time\n{seconds}\t0:00:00\t120.5\t{seconds / 2}\n")
    return {
        "run_folder": run,
        "tables": [run / "tables/skeleton_reconstruction.csv", run / "tables/object_classification.csv"],
        "figures": [FigureSource("gradient", "A gradient", "*Colours* from ``black`` to white.",
                                 run / "figures/gradient.png")],
        "scenes": scenes,
        "config": run / "config.yaml",
        "provenance": run / "provenance.json",
        "manifests": [root / "solids.csv"],
    }  # fmt: skip
