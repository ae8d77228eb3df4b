from pathlib import Path

import numpy as np
import pytest
import trimesh
from coloured import SKELETON, SURFACE

from morphoskel.errors import InputError
from morphoskel.exporting.export import EXPORT_SUFFIXES, check_export_suffix, export_skeleton
from morphoskel.formats.skeleton_file import read_skeleton
from morphoskel.shapes import Skeleton


def test_arrays_come_back_exactly(tmp_path):
    export_skeleton(tmp_path / "a.npz", SKELETON, SURFACE)
    back = read_skeleton(tmp_path / "a.npz")
    for name in vars(SKELETON):
        np.testing.assert_array_equal(getattr(back, name), getattr(SKELETON, name))
    with np.load(tmp_path / "a.npz") as arrays:
        np.testing.assert_array_equal(arrays["surface_vertices"], SURFACE.vertices)
        np.testing.assert_array_equal(arrays["surface_triangles"], SURFACE.triangles)


def test_arrays_that_a_skeleton_lacks_are_absent(tmp_path):
    export_skeleton(tmp_path / "a.npz", Skeleton(SKELETON.points, SKELETON.radii))
    with np.load(tmp_path / "a.npz") as arrays:
        assert set(arrays) == {"points", "radii"}


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".GLB"])
def test_every_format_shows_the_same_solid(tmp_path, suffix):
    export_skeleton(tmp_path / f"a{suffix}", Skeleton(SKELETON.points, SKELETON.radii), subdivisions=3)
    mesh = trimesh.load(tmp_path / f"a{suffix}", force="mesh")
    assert len(mesh.faces) == 4 * 1280
    assert mesh.volume == pytest.approx(4 / 3 * np.pi * (SKELETON.radii**3).sum(), rel=0.02)


@pytest.mark.parametrize("suffix", EXPORT_SUFFIXES)
def test_equal_skeletons_give_equal_bytes(tmp_path, suffix):
    for name in ("a", "b"):
        export_skeleton(tmp_path / f"{name}{suffix}", SKELETON, SURFACE)
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


@pytest.mark.parametrize(("name", "message"), [("a.stl", r"cannot write \.stl"), ("a", "a file without suffix")])
def test_other_formats_are_refused(name, message):
    with pytest.raises(InputError, match=rf"{message}; expected one of \.ply, \.obj, \.glb, \.npz"):
        check_export_suffix(Path(name))
