"""Reports for the browser: a small one, and one as large as the bounds let it be."""

import io

import numpy as np
import pandas as pd
from PIL import Image
from small_run import PROVENANCE, result_frame
from solids import ball

from morphoskel.reporting.page.assets import data_uri
from morphoskel.reporting.page.configuration import Configuration
from morphoskel.reporting.page.embedded_figures import (
    ALL_BYTES,
    MOST_BYTES,
    EmbeddedFigure,
    FigureSource,
    embed_figures,
)
from morphoskel.reporting.page.failures import FailureGroup, Failures
from morphoskel.reporting.page.report_page import ReportContent, render_report
from morphoskel.reporting.page.reported_tables import read_reported_table
from morphoskel.reporting.page.stage_times import StageTime
from morphoskel.reporting.scene import Layer, Scalar, Scene
from morphoskel.reporting.scene_layers import mesh_layer, skeleton_layers
from morphoskel.reporting.table import MEASURED_COLUMNS, assemble, write_table
from morphoskel.shapes import Skeleton

PUBLISHED = ["method", "group", "metric", "value"]
TIMES = [StageTime(rule, jobs, seconds, seconds / jobs, float("nan"), 512.0)
         for rule, jobs, seconds in (("train", 4, 900.0), ("udf", 1200, 61.0), ("dpc", 10, 5.0))]  # fmt: skip


def scene(name, inner_points, subdivisions):
    """A ball with a surface, balls in it, and inner points with a number each."""
    generator = np.random.default_rng(0)
    points = generator.normal(size=(inner_points, 3)) / 4
    centres = points[:200]
    balls = Skeleton(centres, np.full(len(centres), 0.1), np.linspace(0, 0.1, len(centres)))
    residues = Scalar("residue of an inner point, in the shape's unit", generator.random(inner_points))
    return Scene(
        name,
        [mesh_layer(ball(subdivisions=subdivisions), "closed surface"), *skeleton_layers(balls, "balls"),
         Layer("inner points", "points", points, scalars=(residues,), visible=False)],
    )  # fmt: skip


def picture(folder, name):
    """A plain picture, wider than a page."""
    Image.new("RGB", (1800, 300), (200, 220, 240)).save(folder / f"{name}.png")
    return FigureSource(name, f"Figure {name}", f"A caption of *{name}*.", folder / f"{name}.png")


def full_figures(folder, count):
    """Pictures with as many bytes as a figure may have."""
    pixels = np.random.default_rng(0).integers(0, 256, (500, 1000, 3), dtype=np.uint8)
    stream = io.BytesIO()
    Image.fromarray(pixels).resize((2000, 1000)).save(stream, "WEBP", quality=75, method=0)
    address = data_uri(stream.getvalue()[:MOST_BYTES].ljust(MOST_BYTES, b"\0"), "image/webp")
    sources = [FigureSource(f"figure_{number}", f"Figure {number}", "A caption.", folder) for number in range(count)]
    return [EmbeddedFigure(source, address, 2000, 1000) for source in sources]


def wide_frame(methods, groups):
    """Numbers of many methods in many groups and several metrics, half of them printed too."""
    generator = np.random.default_rng(1)
    names = [f"Method {number}, of a long name" for number in range(methods)]
    keys = [(method, f"Group {group}", metric)
            for metric in ("cd_recon", "hd_recon", "cd_mat", "hd_mat", "seconds") for method in names
            for group in range(groups)]  # fmt: skip
    measured = [(*key, value, 0.1, 9, 0) for key, value in zip(keys, generator.random(len(keys)), strict=True)]
    printed = [(*key, value) for key, value in zip(keys[::2], generator.random(len(keys[::2])), strict=True)]
    return assemble(pd.DataFrame(measured, columns=list(MEASURED_COLUMNS)), pd.DataFrame(printed, columns=PUBLISHED),
                    dataset="solids", seeds=[7], protocol="correct")  # fmt: skip


def write_page(folder, frames, figures, scenes):
    """Write tables and page, and return the page's path."""
    for name, frame in frames.items():
        write_table(frame, folder / name, f"Caption of {name}.", ["First note.", "Second note."])
    content = ReportContent(
        run="browser",
        tables=[read_reported_table(folder / f"{name}.csv") for name in frames],
        figures=figures,
        scenes=scenes,
        configuration=Configuration({"seed": 7}, "seed: 7\n" + "key: value\n" * 300),
        provenance=PROVENANCE,
        splits=[],
        failures=Failures(9, 4, 1, (FailureGroup("udf", "ShapeError: a long reason " * 9, ("poisson",), 4, ("a",)),)),
        times=TIMES,
    )
    path = folder / "index.html"
    path.write_text(render_report(content), encoding="utf-8")
    return path


def small_page(folder):
    frames = {"skeleton_reconstruction": result_frame(), "surface_reconstruction": wide_frame(4, 14)}
    figures = embed_figures([picture(folder, "one")])
    return write_page(folder, frames, figures, [scene("first", 500, 2), scene("second", 9, 1)])


def large_page(folder):
    frame = wide_frame(30, 10)
    frames = {f"table_{number}": frame for number in range(6)}
    scenes = [scene(f"shape {number}", 20_000, 5) for number in range(8)]
    return write_page(folder, frames, full_figures(folder, ALL_BYTES // MOST_BYTES), scenes)
