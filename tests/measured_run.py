"""The folder of a finished run with times and sizes that are known, for the tests of planning."""

import yaml

from morphoskel.chain.status import Status, write_status
from morphoskel.config import compose

SHAPES = 6
OVERRIDES = ["experiment=demo", "shard_size=4", "cores=2", "dataset.categories=[Chair,Mug]",
             "dataset.per_category={train: 1, test: 3}", "skeleton.candidates.count=1000"]  # fmt: skip
SECONDS = {"reconstruct": 3.0, "watertight": 5.0, "udf": 2.0}
BYTES = 100


def config(*overrides):
    return compose([*OVERRIDES, *overrides]).model_dump(mode="json")


def write_measured_run(folder):
    """Write two shards, of four and of two test shapes, whose jobs took ``SECONDS`` each, half of it at work."""
    folder.mkdir(parents=True)
    (folder / "config.yaml").write_text(yaml.safe_dump(config()))
    (folder / "tables").mkdir()
    (folder / "tables" / "skeleton_reconstruction.csv").write_text("")
    where = {"reconstruct": "surfaces"}
    for shard, count in (("00000", 4), ("00001", 2)):
        for rule, seconds in SECONDS.items():
            place = f"synthetic/test/poisson/{shard}"
            benchmark = folder / "benchmarks" / rule / f"{place}.tsv"
            benchmark.parent.mkdir(parents=True, exist_ok=True)
            benchmark.write_text(f"s\th:m:s\tcpu_time\n{seconds}\t0:00:01\t{seconds / 2}\n")
            output = folder / where.get(rule, rule) / place
            output.mkdir(parents=True)
            names = [f"{shard}-{number}" for number in range(count)]
            write_status(output, [Status(name, "Chair", "ok", rule, "", 1, 0.1, 0.1, "") for name in names])
            for name in names:
                (output / f"{name}.ply").write_bytes(b"x" * BYTES)
    old = folder / "benchmarks" / "watertight" / "elsewhere" / "test" / "poisson" / "00000.tsv"
    old.parent.mkdir(parents=True)
    old.write_text("s\th:m:s\tcpu_time\n9\t0:00:01\t-\n")  # of a data set that the configuration does not name
    return folder
