"""Small results of samplers, shared by the tests of the sampling tables."""

import math

import pandas as pd

from morphoskel.reporting.sampling_rows import DRAW_COLUMNS, SHAPE_COLUMNS


def shape_rows(sampler, values, ratio="8", seed=0, choice="drawn", classifier="dropout", category="chair", **more):
    """One row a shape, called a, b, ...; a value of NaN is a shape that failed."""
    rows = []
    for letter, value in zip("abcdefghijklmnopqrstuvwxyz", values, strict=False):
        failed = math.isnan(value)
        row = (sampler, ratio, seed, choice, classifier, letter, category, "failed" if failed else "ok",
               "no inside" if failed else "", value, value, value / 2, math.nan if failed else 100.0)  # fmt: skip
        rows.append(dict(zip(SHAPE_COLUMNS, row, strict=True)) | more)
    return rows


def draw_rows(sampler, accuracies, ratio="8", seed=0, choice="drawn", classifier="dropout"):
    """One row a draw."""
    return [
        dict(zip(DRAW_COLUMNS, (sampler, ratio, seed, choice, classifier, draw, oa, oa, oa / 2), strict=True))
        for draw, oa in enumerate(accuracies)
    ]


def shape_frame(*parts):
    return pd.DataFrame([row for part in parts for row in part], columns=list(SHAPE_COLUMNS))


def draw_frame(*parts):
    return pd.DataFrame([row for part in parts for row in part], columns=list(DRAW_COLUMNS))
