import numpy as np
import pytest
from solids import ball, sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply, write_mesh_ply, write_skeleton_npz, write_skeleton_ply
from morphoskel.formats.skeleton_file import read_arrays, read_skeleton, read_skeleton_or_shape
from morphoskel.shapes import Mesh, PointCloud, Skeleton

POINTS = np.array([[0.1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
FULL = Skeleton(POINTS, np.arange(4.0) / 3, np.arange(4.0), edges=[[0, 3]], triangles=[[0, 1, 2]])
HEADER = "ply\nformat ascii 1.0\nelement vertex 4\n"
ROWS = "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n"


def same(first, second):
    pairs = [(getattr(first, name), getattr(second, name)) for name in vars(first)]
    return all((a is None) == (b is None) and (a is None or np.array_equal(a, b)) for a, b in pairs)


@pytest.mark.parametrize("skeleton", [FULL, Skeleton(POINTS, np.arange(4.0))], ids=["full", "bare"])
@pytest.mark.parametrize(("suffix", "write"), [(".ply", write_skeleton_ply), (".NPZ", write_skeleton_npz)])
def test_what_skeletonize_writes_is_read_exactly(tmp_path, skeleton, suffix, write):
    write(tmp_path / f"a{suffix}", skeleton)
    assert same(read_skeleton(tmp_path / f"a{suffix}"), skeleton)


def test_medial_axes(tmp_path):
    (tmp_path / "a.ma").write_text("2 1 0\nv 0 0 0 1\nv 1 0 0 0.5\ne 0 1\n")
    axis = read_skeleton(tmp_path / "a.ma")
    assert (axis.radii.tolist(), axis.edges.tolist()) == ([1, 0.5], [[0, 1]])
    (tmp_path / "b.ply").write_text(HEADER + "".join(f"property float {name}\n" for name in "xyzr") + ROWS)
    assert read_skeleton(tmp_path / "b.ply").radii.tolist() == [1, 2, 3, 4]


def test_red_is_no_radius(tmp_path):
    (tmp_path / "a.ply").write_text(
        HEADER + "".join(f"property float {name}\n" for name in "xyzrgb") + ROWS.replace("\n", " 0 0\n", 5)
        .replace("end_header 0 0", "end_header")
    )  # fmt: skip
    assert isinstance(read_skeleton_or_shape(tmp_path / "a.ply"), PointCloud)


def test_clouds_and_meshes_are_told_from_skeletons(tmp_path):
    write_cloud_ply(tmp_path / "cloud.ply", sphere_cloud(20))
    write_mesh_ply(tmp_path / "mesh.ply", ball(subdivisions=1))
    np.savez(tmp_path / "points.npz", points=POINTS)
    (tmp_path / "a.xyz").write_text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
    assert isinstance(read_skeleton_or_shape(tmp_path / "mesh.ply"), Mesh)
    for name in ("cloud.ply", "points.npz", "a.xyz"):
        assert isinstance(read_skeleton_or_shape(tmp_path / name), PointCloud)
        with pytest.raises(InputError, match=rf"{name}: expected a skeleton \(a PLY file .*found PointCloud"):
            read_skeleton(tmp_path / name)


def test_files_that_are_broken_name_themselves(tmp_path):
    for name in ("gone.ply", "gone.npz", "gone.ma"):
        with pytest.raises(InputError, match=rf"{name}: cannot be read"):
            read_skeleton(tmp_path / name)
    with pytest.raises(InputError, match=r"a\.docx: unknown format '\.docx'; expected one of \.ply"):
        read_skeleton(tmp_path / "a.docx")
    (tmp_path / "bad.npz").write_bytes(b"no archive")
    with pytest.raises(InputError, match=r"bad\.npz: expected an NPZ file"):
        read_skeleton(tmp_path / "bad.npz")
    with (tmp_path / "single.npz").open("wb") as stream:
        np.save(stream, POINTS)
    with pytest.raises(InputError, match=r"single\.npz: expected an NPZ file with arrays"):
        read_arrays(tmp_path / "single.npz")
    np.savez(tmp_path / "short.npz", points=POINTS, radii=[1.0])
    with pytest.raises(InputError, match=r"short\.npz: radii: expected shape \(4,\)"):
        read_skeleton(tmp_path / "short.npz")
    write_skeleton_ply(tmp_path / "empty.ply", Skeleton(np.empty((0, 3)), []))
    with pytest.raises(InputError, match=r"empty\.ply: the skeleton has no balls"):
        read_skeleton(tmp_path / "empty.ply")
    np.savez(tmp_path / "pickled.npz", points=np.array([{}]), radii=np.ones(1))
    with pytest.raises(InputError, match=r"pickled\.npz: expected an NPZ file with arrays of numbers"):
        read_skeleton(tmp_path / "pickled.npz")
