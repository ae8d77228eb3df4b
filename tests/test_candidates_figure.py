from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from illustrated import illustrated

from morphoskel.errors import InputError
from morphoskel.reporting.figures.candidates import draw_candidates, draw_candidates_from_files, shares_of_bins
from morphoskel.reporting.illustration_file import write_illustration


def test_shares_are_of_the_points_selected_and_of_all():
    torus = illustrated("torus")
    selected, everything = shares_of_bins(torus)
    assert selected.sum() == pytest.approx(100)
    assert everything.sum() == pytest.approx(100)
    residues, edges = torus.residues[torus.selected], torus.residue_edges
    naive = [sum(low <= residue < high for residue in residues) for low, high in pairwise(edges)]
    assert np.allclose(selected, 100 * np.array(naive) / 50)
    assert selected[0] == pytest.approx(100 * (residues == 0).mean())


def test_both_numbers_of_candidates_are_drawn(tmp_path):
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    few, many = illustrated("torus", count=1500), illustrated("torus")
    draw_candidates(paths, few, many, pixels=100)
    assert paths[1].read_bytes().startswith(b"%PDF")
    draw_candidates([tmp_path / "other.png"], many, few, pixels=100)
    assert (tmp_path / "other.png").read_bytes() != paths[0].read_bytes()


def test_residues_that_are_all_zero_are_drawn(tmp_path):
    torus = illustrated("torus")
    counts = np.zeros_like(torus.residue_counts)
    counts[0] = torus.inner_count
    flat = replace(torus, dilated=torus.udf, residue_counts=counts)
    draw_candidates([tmp_path / "flat.png"], flat, flat, pixels=60)
    assert (tmp_path / "flat.png").stat().st_size > 1000


def test_different_shapes_are_refused(tmp_path):
    with pytest.raises(InputError, match="got torus and box"):
        draw_candidates([tmp_path / "figure.png"], illustrated("torus"), illustrated("box"))


def test_files_are_drawn_like_the_illustrations_in_them(tmp_path):
    few, many = illustrated("torus", count=1500), illustrated("torus")
    for name, illustration in (("few", few), ("many", many)):
        write_illustration(tmp_path / f"{name}.npz", illustration)
    draw_candidates_from_files([tmp_path / "a.png"], tmp_path / "few.npz", tmp_path / "many.npz", pixels=60)
    draw_candidates([tmp_path / "b.png"], few, many, pixels=60)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
