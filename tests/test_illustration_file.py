from dataclasses import fields

import numpy as np
import pytest
from illustrated import illustrated
from solids import sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply, write_mesh_ply
from morphoskel.reporting.illustrated_shapes import named_shape
from morphoskel.reporting.illustration_file import illustrate_to_file, read_illustration, write_illustration

SETTINGS = {
    "candidates": {"mode": "random", "count": 3000},
    "k": 20,
    "points": 40,
    "seed": 5,
    "reconstruction": {"depth": 5},
    "watertight_settings": {"resolution": 2000},
    "threads": 1,
}


@pytest.fixture
def stored(tmp_path):
    path = tmp_path / "box.npz"
    write_illustration(path, illustrated("box"))
    return path


def change(path, **arrays):
    with np.load(path) as archive:
        content = dict(archive) | arrays
    np.savez(path, **{name: value for name, value in content.items() if value is not None})


def test_what_is_written_is_read_again(stored):
    before, after = illustrated("box"), read_illustration(stored)
    for field in fields(before):
        first, second = getattr(before, field.name), getattr(after, field.name)
        if field.name == "surface":
            assert np.array_equal(first.vertices, second.vertices)
            assert np.array_equal(first.triangles, second.triangles)
        elif isinstance(first, np.ndarray):
            assert first.dtype == second.dtype
            assert np.array_equal(first, second)
        else:
            assert first == second
    assert [path.name for path in stored.parent.iterdir()] == ["box.npz"]


def test_equal_illustrations_are_equal_files(stored, tmp_path):
    write_illustration(tmp_path / "again.npz", illustrated("box"))
    assert (tmp_path / "again.npz").read_bytes() == stored.read_bytes()


def test_a_missing_array_is_named(stored):
    change(stored, udf=None, k=None)
    with pytest.raises(InputError, match=r"box\.npz: expected an illustration, but it has no k, udf"):
        read_illustration(stored)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("k", 2.5, "k: expected one whole number"),
        ("name", np.array(["a", "b"]), "name: expected one text"),
        ("udf", np.zeros(3, dtype=np.float32), "udf: expected shape"),
        ("triangles", np.array([[0, 1, 99]]), "indices must lie in"),
        ("selected", np.array([[0]]), "selected: expected shape"),
        ("residue_counts", np.array(3), "residue_counts: expected shape"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(stored, name, value, message):
    change(stored, **{name: value})
    with pytest.raises(InputError, match=message):
        read_illustration(stored)


def test_a_damaged_file_and_objects_that_could_run_code_are_refused(stored):
    change(stored, udf=np.array([{"a": 1}], dtype=object))
    with pytest.raises(InputError, match="expected an NPZ file"):
        read_illustration(stored)
    stored.write_bytes(stored.read_bytes()[:100])
    with pytest.raises(InputError, match="expected an NPZ file"):
        read_illustration(stored)


def test_exact_solids_stay_exact_and_other_meshes_are_closed(tmp_path):
    illustrate_to_file(tmp_path / "box.npz", "box", samples=200, **SETTINGS)
    box = read_illustration(tmp_path / "box.npz")
    assert np.array_equal(box.surface.vertices, named_shape("box").vertices)
    write_mesh_ply(tmp_path / "mine.ply", named_shape("box"))
    illustrate_to_file(tmp_path / "mine.npz", tmp_path / "mine.ply", samples=None, **SETTINGS)
    mine = read_illustration(tmp_path / "mine.npz")
    assert mine.name == "mine"
    assert len(mine.surface.vertices) > 500
    assert np.allclose(mine.surface.bounds, box.surface.bounds, atol=0.05)


def test_the_surface_of_a_cloud_is_rebuilt(tmp_path):
    write_cloud_ply(tmp_path / "ball.ply", sphere_cloud(400))
    illustrate_to_file(tmp_path / "ball.npz", tmp_path / "ball.ply", samples=None, **SETTINGS)
    ball = read_illustration(tmp_path / "ball.npz")
    assert len(ball.cloud) == 400
    assert np.linalg.norm(ball.surface.vertices, axis=1).mean() == pytest.approx(1, abs=0.12)
    assert ball.udf.max() == pytest.approx(1, abs=0.2)


def test_triangles_that_are_no_whole_numbers_are_refused(tmp_path):
    path = tmp_path / "ball.npz"
    write_illustration(path, illustrated())
    with np.load(path) as stored:
        arrays = dict(stored)
    arrays["triangles"] = arrays["triangles"].astype(float)
    arrays["triangles"][0, 0] = np.nan
    np.savez(path, **arrays)
    with pytest.raises(InputError, match=r"ball\.npz: triangles: expected whole numbers"):
        read_illustration(path)
