from itertools import product
from pathlib import Path

import pandas as pd
import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.matrix import rivals
from morphoskel.reporting.sampling_names import (
    CHOICE_SUFFIXES,
    CLASSIFIER_SUFFIXES,
    SAMPLER_NAMES,
    SAMPLER_TABLES,
    SAMPLING_TABLES,
    belongs,
    difference_name,
    ordered_names,
    row_name,
)
from morphoskel.sampling.samplers import SAMPLERS

PAPER = Path(__file__).resolve().parents[1] / "config" / "paper"
SETTINGS = list(product(SAMPLER_NAMES, CHOICE_SUFFIXES, CLASSIFIER_SUFFIXES))


def test_every_sampler_has_a_name():
    assert set(SAMPLER_NAMES) == {"all_points", *SAMPLERS}


def test_the_paper_and_the_usual_choices_have_the_same_names():
    ours = {row_name(sampler, "drawn", "dropout") for sampler in SAMPLER_NAMES}
    for path in PAPER.glob("*_oa.csv"):
        assert set(pd.read_csv(path)["method"]) <= ours
    assert row_name("fps", "fixed", "dropout") == "FPS"


def test_other_rows_say_what_differs():
    assert row_name("ms3d", "argmax", "dropout") == "MS3D, arg-max"
    assert row_name("skeleton_aware", "completed", "dropout") == "SA, completed"
    assert row_name("lfs", "fixed", "plain") == "LFS-weighted FPS, classifier without point dropout"
    assert difference_name("ms3d", "uniform", "argmax") == "MS3D minus uniform prior, arg-max"


def test_rows_of_one_classifier_are_rivals():
    for row in SETTINGS:
        assert rivals(row_name(*row)) == CLASSIFIER_SUFFIXES[row[2]]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (("pointnet", "drawn", "dropout"), "no sampler 'pointnet'; known are all_points, random"),
        (("fps", "best", "dropout"), "no choice 'best'; known are fixed"),
        (("fps", "fixed", "other"), "no classifier 'other'; known are dropout, plain"),
    ],
)
def test_unknown_names_are_refused(name, message):
    with pytest.raises(InputError, match=message):
        row_name(*name)


def test_each_table_has_its_rows():
    names = {table: {row_name(*row) for row in SETTINGS if belongs(table, *row)} for table in SAMPLING_TABLES}
    first, second = (names[table] for table in SAMPLER_TABLES)
    assert first == second
    assert {"Random", "LFS-weighted FPS", "MS3D, arg-max", "SA, completed", "uniform prior"} < first
    assert "FPS, classifier without point dropout" in first
    assert not {"DPC", "L1", "All points", "MS3D, arg-max, classifier without point dropout"} & first
    assert {"Random", "L1", "L1, arg-max", "shuffled prior, arg-max"} < names["skeleton_prior"]
    assert not {"FPS", "S-NET", "SA, completed"} & names["skeleton_prior"]


def test_training_free_samplers_come_first_then_learned_ones_controls_and_twins():
    names = ordered_names()
    assert len(names) == len(set(names))
    shown = ["Random", "FPS", "LFS-weighted FPS", "S-NET", "MetaSampler", "SA", "MS3D", "uniform prior",
             "SA, arg-max", "SA, completed", "MS3D, arg-max", "Random, classifier without point dropout",
             "MS3D minus SA", "MS3D minus SA, arg-max"]  # fmt: skip
    assert [name for name in names if name in shown] == shown
    for table, row in product(SAMPLING_TABLES, SETTINGS):
        assert not belongs(table, *row) or row_name(*row) in names
