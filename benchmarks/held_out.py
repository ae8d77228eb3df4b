"""Whether a skeleton explains the surface, or only the very points that it was made from.

The coverage selection and Coverage Axis++ look at the cloud on which the tables measure them. Here each skeleton, with
its surface, is made from every other point of a cloud and measured on both halves.
"""

import logging
from pathlib import Path

import pandas as pd

from benchmarks.surfaces import SEED, read_clouds
from morphoskel.evaluation.sphere_metrics import cd_recon, hd_recon, sphere_distances
from morphoskel.methods import SURFACE_METHODS
from morphoskel.run_method import skeleton_inside
from morphoskel.shapes import PointCloud
from morphoskel.surface import reconstruct, watertight
from morphoskel.volume import Candidates

logger = logging.getLogger(__name__)

SURFACES = ("poisson", "repaired_poisson")
SHAPES_A_CATEGORY = 5
CANDIDATES = 1_000_000
BALLS = 1024


def run(folder: Path) -> bool:
    """Write ``held_out.csv``; return whether the coverage selection beats the paper's on points that it never saw."""
    rows = []
    for number, (category, cloud) in enumerate(read_clouds(SHAPES_A_CATEGORY), 1):
        seen = PointCloud(cloud.points[::2], None if cloud.normals is None else cloud.normals[::2])
        for surface in SURFACES:
            closed = watertight(reconstruct(seen, surface), seed=SEED)
            box = Candidates(*closed.bounds, CANDIDATES, seed=SEED)
            for method in SURFACE_METHODS:
                settings = {"stop_when_covered": False} if method == "coverage_axis" else {}
                skeleton = skeleton_inside(method, closed, box, seen.points, k=20, points=BALLS, settings=settings)
                row = {"shape": number, "category": category, "surface": surface, "method": method}
                for half, points in (("seen", seen.points), ("held_out", cloud.points[1::2])):
                    distances = sphere_distances(points, skeleton.points, skeleton.radii)
                    row |= {f"cd_{half}": cd_recon(distances, "correct"), f"hd_{half}": hd_recon(distances)}
                rows.append(row)
        logger.info("%d %s", number, category)
    frame = pd.DataFrame(rows)
    columns = ["cd_seen", "hd_seen", "cd_held_out", "hd_held_out"]
    by_category = frame.groupby(["surface", "method", "category"])[columns].mean()
    means = by_category.groupby(["surface", "method"]).mean()
    means.insert(0, "shapes", frame["shape"].nunique())
    means.to_csv(folder / "held_out.csv", float_format="%.4f")
    logger.info("%s", means)
    held_out = means[["cd_held_out", "hd_held_out"]]
    return all((held_out.loc[(name, "ms3d_coverage")] < held_out.loc[(name, "ms3d")]).all() for name in SURFACES)
