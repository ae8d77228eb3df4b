"""The two computations that are compared, each run in a process of its own by :mod:`benchmarks.ms3d`."""

import json
import resource
import sys
import time
from pathlib import Path

import numpy as np

K, KEPT = 20, 1024
SEED = 1
TINY = 1000
"""Candidates of the run that goes before the clock is started: it loads libraries and compiled code."""


def released(surface: Path, mode: str, count: int, seed: int = SEED):
    """Do as published, with Open3D's own calls: ray parity, exact distance, k-NN, gather and maximum, top-k.

    Candidates are made within its time, as published. On the grid they are the same points as ours; random ones are
    thrown away after the clock is stopped, and it goes on with ours in random order, so that answers can be compared.
    """
    import open3d

    from morphoskel.formats.read_mesh import read_mesh
    from morphoskel.volume import Candidates

    mesh = read_mesh(surface)
    candidates = Candidates(*mesh.bounds, count, mode, seed)
    start = time.perf_counter()
    if mode == "random":
        generator = np.random.default_rng(seed)
        points = generator.uniform(candidates.lower, candidates.upper, (count, 3)).astype(np.float32)
        spent = time.perf_counter() - start
        points = np.concatenate(list(candidates.chunks()))[generator.permutation(count)]
        start = time.perf_counter() - spent
    else:
        corners = zip(candidates.lower, candidates.upper, strict=True)
        axes = [np.linspace(low, high, candidates.nodes_per_axis) for low, high in corners]
        points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3).astype(np.float32)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    inner = points[scene.compute_occupancy(open3d.core.Tensor(points)).numpy() == 1]
    udf = scene.compute_distance(open3d.core.Tensor(inner)).numpy()
    search = open3d.core.nns.NearestNeighborSearch(open3d.core.Tensor(inner))
    search.knn_index()
    neighbours, _ = search.knn_search(open3d.core.Tensor(inner), K)
    residues = udf[neighbours.numpy()].max(axis=1) - udf
    kept = np.argpartition(residues, KEPT)[:KEPT] if len(residues) > KEPT else np.arange(len(residues))
    return time.perf_counter() - start, inner, udf, residues, kept


def ours(surface: Path, mode: str, count: int, seed: int = SEED, threads: int | None = None):
    """Do the same with this library; the candidates are made within its time."""
    from morphoskel.cores import available_cores
    from morphoskel.formats.read_mesh import read_mesh
    from morphoskel.morphology import dilation, residue
    from morphoskel.skeleton import select_smallest_residues
    from morphoskel.volume import Candidates, SurfaceDistance, occupancy

    threads = threads or available_cores()
    mesh = read_mesh(surface)
    start = time.perf_counter()
    candidates = Candidates(*mesh.bounds, count, mode, seed)
    inner = occupancy(mesh, candidates, threads=threads).inner_points(threads=threads)
    udf = SurfaceDistance(mesh)(inner, threads=threads)
    residues = residue(udf, dilation(inner, udf, K, threads=threads))
    kept = select_smallest_residues(residues, udf, KEPT)
    return time.perf_counter() - start, inner, udf, residues, kept


def peak_memory():
    """Return the most memory, in MB, that this process has held since its program was started.

    ``ru_maxrss`` will not do where there is better: it counts what the process held as a copy of its parent, too.
    """
    status = Path("/proc/self/status")
    if status.is_file():
        fields = dict(line.split(":", 1) for line in status.read_text().splitlines())
        return int(fields["VmHWM"].split()[0]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(arguments):
    """Run one computation, print seconds, inner points and peak memory, and write what it found."""
    name, surface, mode, count, answer = arguments
    compute = {"released": released, "ours": ours}[name]
    compute(Path(surface), mode, TINY)
    seconds, inner, udf, residues, kept = compute(Path(surface), mode, int(count))
    peak = peak_memory()
    if answer != "-":
        np.savez(answer, inner=inner, udf=udf, residues=residues, kept=kept)
    sys.stdout.write(json.dumps({"seconds": seconds, "inside": len(inner), "peak_mb": peak}) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
