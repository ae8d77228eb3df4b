"""Compute small outputs of every kind, to be compared bit by bit: ``python -m benchmarks.determinism_outputs FILE``."""

import argparse
import logging
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

Arrays = dict[str, npt.NDArray]

SEED = 7
CHAIN = {
    "candidates": {"mode": "random", "count": 8000},
    "k": 20,
    "points": 64,
    "reconstruction": {"depth": 5},
    "watertight_settings": {"resolution": 1000},
}
INSIDE = ("ms3d", "ms3d_coverage", "coverage_axis")
ON_CLOUDS = {"l1_medial": {"samples": 60}, "dpc": {"samples": 60, "max_steps": 40, "iterations": 1}}


def compute(threads: int = 1) -> Arrays:
    """Return outputs by name, ``kind: what``.

    Parameters
    ----------
    threads
        Threads of the chain and of Open3D; trainings always have one.
    """
    outputs: Arrays = {}
    for name, cloud in _clouds().items():
        outputs |= {f"{kind}, {name}: {what}": array for kind, what, array in _of_shape(name, cloud, threads)}
    return {**outputs, "table: files": _table(outputs), **_trained()}


def _clouds():
    """Return an ellipsoid with normals and a bent tube without."""
    from morphoskel.shapes import PointCloud

    generator = np.random.default_rng(SEED)
    directions = generator.normal(size=(400, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    along, around = generator.uniform(0, 2, 400), generator.uniform(0, 2 * np.pi, 400)
    tube = np.stack([along, 0.25 * np.cos(around) + 0.3 * along**2, 0.25 * np.sin(around)], axis=1)
    return {"ellipsoid": PointCloud(directions * [1, 0.7, 0.5], directions), "tube": PointCloud(tube)}


def _of_shape(name, cloud, threads) -> Iterator[tuple[str, str, npt.NDArray]]:
    """Yield the surface, the skeletons, and what the tables and samplers make of them."""
    from morphoskel.evaluation.sphere_metrics import cd_recon, hd_recon, sphere_distances
    from morphoskel.sampling.lfs import LfsSettings, lfs_points
    from morphoskel.sampling.prior import local_feature_size
    from morphoskel.skeletonization import skeletonize_shape

    shape = cloud
    for method in INSIDE:
        result = skeletonize_shape(
            cloud, method=method, surface="poisson", seed=SEED, name=name, threads=threads, **CHAIN
        )
        skeleton = result.skeleton
        if method == "ms3d":
            shape = result.surface
            yield "surface", "vertices", shape.vertices
            yield "surface", "triangles", shape.triangles
        yield method, "centres", skeleton.points
        yield method, "radii", skeleton.radii
        distances = sphere_distances(cloud.points, skeleton.points, skeleton.radii)
        yield "evaluation", method, np.array([cd_recon(distances, "correct"), hd_recon(distances)])
    sizes = local_feature_size(cloud.points, skeleton.points)
    yield "sampling", "local feature sizes", sizes
    yield "sampling", "points chosen by lfs", lfs_points(cloud.points, sizes, 32, LfsSettings(exponent=1.0, floor=0.1))
    for method, settings in ON_CLOUDS.items():
        skeleton = skeletonize_shape(
            cloud, method=method, settings=settings, seed=SEED, name=name, threads=threads,
            **{key: CHAIN[key] for key in ("candidates", "k", "points")},
        ).skeleton  # fmt: skip
        yield method, "centres", skeleton.points
        yield method, "radii", skeleton.radii


def _table(outputs: Arrays) -> npt.NDArray[np.uint8]:
    """Return the bytes of a table's files with the evaluations."""
    import pandas as pd

    from morphoskel.reporting.table import MEASURED_COLUMNS, assemble, write_table

    rows = [
        (method, name, metric, value, value / 3, 1, 0)
        for method in INSIDE
        for name in _clouds()
        for metric, value in zip(("cd_recon", "hd_recon"), outputs[f"evaluation, {name}: {method}"], strict=True)
    ]
    published = pd.DataFrame([(INSIDE[0], "tube", "cd_recon", 0.1)], columns=["method", "group", "metric", "value"])
    measured = pd.DataFrame(rows, columns=list(MEASURED_COLUMNS))
    frame = assemble(measured, published, dataset="two shapes", seeds=[SEED], protocol="correct")
    with tempfile.TemporaryDirectory() as folder:
        write_table(frame, Path(folder) / "table", "Caption", ["Note."])
        files = sorted(Path(folder).iterdir())
        return np.frombuffer(b"".join(path.read_bytes() for path in files), dtype=np.uint8)


def _trained() -> Arrays:
    """Return the weights of a classifier after a training, and features and gradients of an edge convolution."""
    import torch

    from morphoskel.learning.train_classifier import train_classifier
    from morphoskel.networks.classifier_settings import ClassifierSettings
    from morphoskel.networks.edge_features import EdgeFeatures

    torch.set_num_threads(1)
    generator = torch.Generator().manual_seed(SEED)
    labels = torch.arange(12) % 2
    clouds = (
        torch.randn(12, 64, 3, generator=generator) * torch.tensor([[0.5, 0.5, 0.5], [0.9, 0.1, 0.1]])[labels, None]
    )
    settings = ClassifierSettings(
        dropped_points=0.5, drop_style="remove", lowest_scale=0.8, highest_scale=1.25, shift=0.1, feature_dropout=0.4,
        penalty=0.001, batch_size=4, epochs=2, learning_rate=1e-3, weight_decay=1e-4, decay=0.7, decay_epochs=1,
    )  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        data = ((clouds[:8], labels[:8]), (clouds[8:], labels[8:]))
        path = train_classifier(
            *data, ("ball", "line"), settings, Path(folder), SEED, accelerator="cpu", progress=False
        )
        weights = torch.load(path, map_location="cpu", weights_only=True)["weights"]
    torch.manual_seed(SEED)
    network = EdgeFeatures(channels=(8, 16), k=6, global_features=16, head=(16, 8))
    features = network(clouds)
    features.square().mean().backward()
    gradients = torch.cat([parameter.grad.flatten() for parameter in network.parameters()])
    return {
        "training: classifier": np.concatenate([value.double().flatten().numpy() for value in weights.values()]),
        "edge convolution: features": features.detach().numpy(),
        "edge convolution: gradients": gradients.numpy(),
    }


def main() -> None:
    """Write the outputs to an NPZ file."""
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--folder", type=Path, help="to work in")
    parsed = parser.parse_args()
    file = parsed.file.resolve()
    if parsed.folder:
        os.chdir(parsed.folder)
    logging.disable(logging.INFO)
    np.savez(file, **compute(parsed.threads))


if __name__ == "__main__":
    main()
