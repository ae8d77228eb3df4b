"""Small results of part segmentation, shared by the tests of its table."""

import math

import pandas as pd

from morphoskel.reporting.segmentation_rows import SEGMENTATION_COLUMNS


def segmentation_rows(strategy, values, ratio="16", seed=0, category="Chair", labels=10.0, **changes):
    """One row a shape, called a, b, ...; a value of NaN is a shape that failed."""
    rows = []
    for letter, value in zip("abcdefghijklmnopqrstuvwxyz", values, strict=False):
        status = "failed" if math.isnan(value) else "ok"
        row = (strategy, ratio, seed, letter, category, status, value, value, labels)
        rows.append(dict(zip(SEGMENTATION_COLUMNS, row, strict=True)) | changes)
    return rows


def segmentation_frame(*parts):
    return pd.DataFrame([row for part in parts for row in part], columns=list(SEGMENTATION_COLUMNS))
