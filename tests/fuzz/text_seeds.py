"""Whole files of tables, lists, archives and configurations, and how their readers are called."""

from __future__ import annotations

import copy
import functools
import gzip
import io
import json
import shutil
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any
from unittest import mock

from fuzz.feedback import untraced
from fuzz.shape_seeds import POINTS, REPOSITORY, extracts, written

RESULT_COLUMNS = ("sampler", "ratio", "seed", "id", "category", "status", "correct")


def manifest_files(folder: Path) -> list[bytes]:
    """Return a manifest of two splits."""
    from morphoskel.datasets.manifest import ShapeRecord, write_manifest

    records = [
        ShapeRecord(f"s{number}", "Chair, old" if number else "Lamp", split, 0, Path(f"a b/{number}.ply"), "0f" * 32)
        for number, split in enumerate(("test", "test", "train"))
    ]
    return written(folder / "seed.csv", lambda path: write_manifest(path, records))


def status_files(folder: Path) -> list[bytes]:
    """Return a shape that passed, and one that failed with a reason of two lines."""
    from morphoskel.chain.status import Status, write_status

    rows = [
        Status("a", "Chair", "ok", "udf", "", 1, 0.5, 1.5, "inner=12;seeds=3"),
        Status("b", "Lamp", "failed", "watertight", 'not "closed",\nsorry', 2, 0.5, 1.5, ""),
    ]
    write_status(folder, rows)
    return [(folder / "status.csv").read_bytes()]


def split_lists(folder: Path) -> list[bytes]:
    """Return a list of shapes."""
    return [b"02691156/1a04e3eab45ca15dd86060f189eb133\r\n\n 03001627/x\n", *extracts("*/modelnet40_*.txt", 1)]


def shapenetpart_lists(folder: Path) -> list[bytes]:
    """Return a split list; two of its shapes are there."""
    for name in ("shape", "other"):
        path = folder / "03467517" / "points" / f"{name}.pts"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("0 0 0\n")
    for split in ("train", "val"):
        lists = folder / "train_test_split" / f"shuffled_{split}_file_list.json"
        lists.parent.mkdir(parents=True, exist_ok=True)
        lists.write_text("[]")
    listed = ["shape_data/03467517/shape", "shape_data/03467517/other"]
    return [json.dumps(listed).encode(), json.dumps(listed[:1], indent=1).encode()]


def label_files(folder: Path) -> list[bytes]:
    """Return the part labels of a guitar; its points are there."""
    path = folder / "03467517" / "points" / "shape.pts"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(" ".join(map(str, point)) for point in POINTS))
    return [b"1\n1\n2\n2\n3\n3\n", b"1\r\n1\r\n1\r\n1\r\n1\r\n1"]


def synthetic_dataset(dataset: Callable[..., Any], root: Path) -> Any:
    """Return the data set that the description is of."""
    (root / "clouds").mkdir(exist_ok=True)
    return dataset(root, per_category={"test": 1}, points=500, seed=3)


def synthetic_descriptions(folder: Path) -> list[bytes]:
    """Return the description that the data set writes."""
    return [json.dumps({"seed": 3, "points": 500}).encode()]


def archives(folder: Path) -> list[bytes]:
    """Return a zip and two tar archives."""
    packed = []
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as archive:
        for name in ("data/a.txt", "data/sub/b.txt"):
            member = tarfile.TarInfo(name)
            member.size = 6
            archive.addfile(member, io.BytesIO(b"0 0 0\n"))
    packed += [stream.getvalue(), gzip.compress(stream.getvalue(), mtime=0)]
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as zipped:
        zipped.writestr(zipfile.ZipInfo("data/a.txt"), "0 0 0\n" * 20, zipfile.ZIP_DEFLATED)
        zipped.writestr(zipfile.ZipInfo("data/sub/b.txt"), "1 1 1\n")
    return [*packed, stream.getvalue()]


def extract_anew(extract: Callable[[Path, Path], None], path: Path) -> None:
    """Unpack into a folder that is not there yet, and see that nothing was written beside it."""
    target = path.parent / "unpacked"
    shutil.rmtree(target, ignore_errors=True)
    try:
        extract(path, target)
    finally:
        strays = {entry.name for entry in path.parent.iterdir()} - {path.name, "unpacked"}
        if strays:
            raise AssertionError(f"written outside of the target folder: {sorted(strays)}")


def published_tables(folder: Path) -> list[bytes]:
    """Return a table of the paper."""
    lines = (REPOSITORY / "config" / "paper" / "processing_time.csv").read_bytes().splitlines(keepends=True)
    return [b"".join(lines[:6]), b"".join(lines[:2])]


def result_tables(folder: Path) -> list[bytes]:
    """Return a result table with a value, one that failed and one that was not run."""
    return [
        b"dataset,method,group,metric,value,std,paper,n,n_failed,seeds,protocol\n"
        b'synthetic,MS3D,Chair,cd_recon,0.0184,,0.0296,32,0,"7,8",correct\n'
        b"synthetic,DPC,Chair,cd_recon,failed,0.1,nan,0,2,7,correct\n"
        b"synthetic,L1,Chair,hd_recon,not run,,,0,0,,correct\n"
    ]


def result_rows(folder: Path) -> list[bytes]:
    """Return rows of two shapes."""
    return [b"sampler,ratio,seed,id,category,status,reason,correct\nfps,8,0,a,nan,ok,,1.0\nfps,8,1,b,Lamp,failed,no,\n"]


def stage_times(folder: Path) -> list[bytes]:
    """Return the times of two stages, one of which failed."""
    return [b"id,category,surface,stage,seconds,threads\na,Chair,poisson,udf,0.25,2\na,Chair,poisson,dilation,,2\n"]


def scaling_files(folder: Path) -> list[bytes]:
    """Return measurements of every stage."""
    stages = ("occupancy", "udf", "dilation")
    rows = "".join(f"1000,{repeat},{stage},0.5,400,2\n" for repeat in (0, 1) for stage in stages)
    return [f"candidates,repeat,stage,seconds,inside,threads\n{rows}".encode()]


def benchmarks(folder: Path) -> list[bytes]:
    """Return what Snakemake writes about a job, and about one that was over at once."""
    head = "s\th:m:s\tmax_rss\tmax_vms\tcpu_time\n"
    return [f"{head}1.5\t0:00:01\t12.5\t40\t1.25\n".encode(), f"{head}0.01\t0:00:00\tNA\tNA\t-\n".encode()]


def provenance_files(folder: Path) -> list[bytes]:
    """Return the provenance of this process."""
    from morphoskel.run_provenance import write_provenance

    return written(folder / "seed.json", write_provenance)


def config_files(folder: Path) -> list[bytes]:
    """Return the configuration of an experiment as a run writes it."""
    import yaml

    from morphoskel.config import compose

    return [
        yaml.safe_dump(compose(overrides).model_dump(mode="json"), sort_keys=False).encode()
        for overrides in (["experiment=smoke"], ["experiment=smoke", "dataset=folder", "dataset.root=/tmp/x"])
    ]


def short_config_files(folder: Path) -> list[bytes]:
    """Return parts of a configuration: Python's own YAML parser takes long for all of it."""
    return [
        b"run: smoke\nseed: 7\ndataset:\n  kind: folder\n  root: /tmp/x\n  categories: null\nparts: {}\n",
        b"started: 2024-01-31\nsurface:\n  poisson: {depth: 8}\nskeleton:\n- &a [1, 2.5]\n- *a\nscale: 1.0e+3\n",
    ]


def override_files(folder: Path) -> list[bytes]:
    """Return overrides, one a line."""
    return [
        b"experiment=smoke\nskeleton.k=30\nseed=7",
        b"dataset=folder\ndataset.root=/tmp/x\nsurface=[poisson,ponq]",
        b"~parts\n++skeleton.points=12\nrun='a b'\nskeleton.candidates.mode=grid",
        b"sampler=[fps,ms3d]\nsampling.points=64\nmax_failed=5",
    ]


def _lines(path: Path) -> list[str]:
    return path.read_bytes().decode("utf-8", errors="replace").split("\n")


def check_overrides(check: Callable[..., None], path: Path) -> None:
    """Check each line."""
    from morphoskel.config import config_folder

    check(_lines(path), config_folder())


def compose(compose: Callable[..., Any], path: Path) -> object:
    """Compose the configuration that the lines ask for.

    Hydra's own work is not traced, and it is given each intact file of the tree as it was parsed the first time: an
    input takes a third of the time so.
    """
    import hydra
    from hydra._internal.config_loader_impl import ConfigLoaderImpl
    from omegaconf import OmegaConf

    with (
        mock.patch.object(OmegaConf, "load", _load_once),
        mock.patch.object(hydra, "compose", untraced()(hydra.compose)),
        mock.patch.object(
            ConfigLoaderImpl, "compute_defaults_list", untraced()(ConfigLoaderImpl.compute_defaults_list)
        ),
    ):
        return compose(_lines(path))


def _load_once(file: IO[str]) -> Any:
    return copy.deepcopy(_parsed(file.read()))


@functools.cache
def _parsed(text: str) -> Any:
    from omegaconf import OmegaConf

    return OmegaConf.create(text or "{}")


def validate(validate: Callable[..., Any], path: Path) -> object:
    """Validate what YAML makes of the file; files that are no YAML are not the schema's to judge."""
    import yaml

    try:
        values = yaml.load(path.read_bytes(), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (yaml.YAMLError, ValueError, RecursionError):
        return None
    return validate(values)
