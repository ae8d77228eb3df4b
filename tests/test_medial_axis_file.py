import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats import write_skeleton_ply
from morphoskel.formats.medial_axis_file import read_medial_axis
from morphoskel.shapes import Skeleton

MA = "4 2 1\nv 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 0.25\nv 0 0 1 1e-12\ne 0 1\ne 1 3\nf 0 1 2\n"
PLY = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def written(folder, text, name="shape.ma"):
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    "text",
    [
        MA,
        MA.replace("\n", "\r\n"),
        "# an axis\n\n" + MA,
        MA.replace("v 1 0 0 0.5", "v 1 0 0 0.5 3 0").replace("e 0 1", "e 0 1 0"),  # flags, as in the files of MATFP
    ],
)
def test_an_ma_file(tmp_path, text):
    axis = read_medial_axis(written(tmp_path, text))
    np.testing.assert_array_equal(axis.points, POINTS)
    np.testing.assert_array_equal(axis.radii, [1, 0.5, 0.25, 1e-12])
    np.testing.assert_array_equal(axis.edges, [[0, 1], [1, 3]])
    np.testing.assert_array_equal(axis.triangles, [[0, 1, 2]])


def test_an_ma_file_of_points_only(tmp_path):
    axis = read_medial_axis(written(tmp_path, "1 0 0\nv 1 2 3 4\n", "SHAPE.MA"))
    assert (len(axis), len(axis.edges), len(axis.triangles)) == (1, 0, 0)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("4 2 1\n", "4 2\n", "line 1: expected the numbers of vertices, edges and faces, got '4 2'"),
        ("4 2 1\n", "4 x 1\n", "line 1: expected the number of edges, got 'x'"),
        ("4 2 1\n", "5 2 1\n", "line 1: declares 5 vertices, but 4 lines 'v' follow; .*truncated"),
        ("f 0 1 2\n", "", "line 1: declares 1 faces, but 0 lines 'f' follow"),
        ("e 0 1\n", "x 0 1\n", "line 6: expected a line 'v', 'e' or 'f', got 'x 0 1'"),
        ("v 1 0 0 0.5", "v 1 0 0", "line 3: expected 'v x y z r', got 'v 1 0 0'"),
        ("v 1 0 0 0.5", "v 1 0 0 a", "line 3: expected only numbers"),
        ("v 1 0 0 0.5", "v 1 0 0 -1", "line 3: expected a point and its radius, got '1 0 0 -1'"),
        ("v 1 0 0 0.5", "v nan 0 0 1", "line 3: expected a point and its radius"),
        ("f 0 1 2", "f 0 1 4", "line 8: expected vertex indices from 0 to 3, got '0 1 4'"),
        ("e 1 3", "e 1 -1", "line 7: expected vertex indices from 0 to 3"),
        ("e 1 3", "e 1 0.5", "line 7: expected vertex indices from 0 to 3"),
        (MA, "0 0 0\n", "has no vertices"),
        (MA, "\n", "found no data"),
    ],
)
def test_damage_is_reported_with_file_and_line(tmp_path, old, new, message):
    assert old in MA
    with pytest.raises(InputError, match=rf"shape\.ma: .*{message}"):
        read_medial_axis(written(tmp_path, MA.replace(old, new, 1)))


def test_a_ply_file_of_points_has_no_radii(tmp_path):
    rows = "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    axis = read_medial_axis(written(tmp_path, PLY + rows, "shape_mat.ply"))
    np.testing.assert_array_equal(axis.points, POINTS)
    np.testing.assert_array_equal(axis.radii, 0)
    assert len(axis.triangles) == 0


@pytest.mark.parametrize("name", ["radius", "r"])
def test_a_ply_file_with_radii_and_a_face(tmp_path, name):
    head = f"property float {name}\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    axis = read_medial_axis(written(tmp_path, PLY + head + "0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n4 0 1 2 3\n", "a.ply"))
    np.testing.assert_array_equal(axis.radii, [1, 2, 3, 4])
    np.testing.assert_array_equal(axis.triangles, [[0, 1, 2], [0, 2, 3]])


def test_our_own_skeletons_are_read_back(tmp_path):
    skeleton = Skeleton(POINTS + 0.1, np.arange(4) / 3, edges=[[0, 3]], triangles=[[3, 2, 1]])
    write_skeleton_ply(tmp_path / "own.ply", skeleton)
    axis = read_medial_axis(tmp_path / "own.ply")
    for part in ("points", "radii", "edges", "triangles"):
        np.testing.assert_array_equal(getattr(axis, part), getattr(skeleton, part))


def test_what_is_no_medial_axis(tmp_path):
    with pytest.raises(InputError, match=r"gone\.ma: cannot be read"):
        read_medial_axis(tmp_path / "gone.ma")
    with pytest.raises(InputError, match=r"a\.obj: expected a medial axis as \.ma or \.ply, got '\.obj'"):
        read_medial_axis(written(tmp_path, MA, "a.obj"))
    with pytest.raises(InputError, match=r"a\.ply: expected a PLY file"):
        read_medial_axis(written(tmp_path, MA, "a.ply"))
    with pytest.raises(InputError, match=r"b\.ply: .*has no vertices"):
        read_medial_axis(written(tmp_path, PLY.replace("vertex 4", "vertex 0") + "end_header\n", "b.ply"))
    edge = "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 4\n"
    with pytest.raises(InputError, match=r"c\.ply: .*range of the centres"):
        read_medial_axis(written(tmp_path, PLY + edge, "c.ply"))


def test_published_axes(real_data):
    matfp = read_medial_axis(real_data / "medial_axis" / "dog_matfp.ma")
    assert (len(matfp), len(matfp.edges), len(matfp.triangles)) == (7982, 26634, 27210)
    qmat = read_medial_axis(real_data / "medial_axis" / "dog_qmat.ma")
    assert (len(qmat), len(qmat.edges), len(qmat.triangles)) == (49, 69, 21)
    assert 0.02 < qmat.radii.min() < qmat.radii.max() < 0.13
