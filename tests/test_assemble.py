import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from morphoskel.errors import InputError
from morphoskel.formats.assemble import (
    Polygons,
    as_whole_numbers,
    assemble_shape,
    scale_to_unit_length,
    triangulate_fans,
)
from morphoskel.shapes import Mesh, PointCloud

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)


def fans_one_by_one(polygons):
    """Naive twin of triangulate_fans."""
    triangles, start = [], 0
    for count in polygons.counts:
        corners = polygons.corners[start : start + count]
        triangles += [[corners[0], corners[step], corners[step + 1]] for step in range(1, count - 1)]
        start += count
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)


@given(st.lists(st.integers(3, 7), min_size=0, max_size=8))
def test_fans_equal_those_cut_one_by_one(counts):
    polygons = Polygons(np.array(counts, dtype=np.int64), np.arange(sum(counts), dtype=np.int64))
    np.testing.assert_array_equal(triangulate_fans(polygons), fans_one_by_one(polygons))


def test_fan_of_a_convex_polygon_keeps_its_area():
    angles = np.linspace(0, 2 * np.pi, 7)[:-1]
    hexagon = np.stack([np.cos(angles), np.sin(angles), np.zeros(6)], axis=1)
    corners = hexagon[triangulate_fans(Polygons(np.array([6]), np.arange(6)))]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (crosses[:, 2] > 0).all()  # the orientation stays
    assert crosses[:, 2].sum() / 2 == pytest.approx(3 * np.sqrt(3) / 2)


def test_a_face_with_two_corners_is_refused():
    with pytest.raises(InputError, match="face 1 has 2 corners"):
        triangulate_fans(Polygons(np.array([3, 2]), np.arange(5)))


def test_faces_decide_what_it_is():
    triangle = Polygons(np.array([3]), np.array([0, 1, 2]))
    assert isinstance(assemble_shape(CORNERS, triangle), Mesh)
    assert isinstance(assemble_shape(CORNERS, Polygons(np.array([], dtype=int), np.array([], dtype=int))), PointCloud)


def test_a_mesh_needs_four_distinct_points_too():
    with pytest.raises(InputError, match="distinct"):
        assemble_shape(CORNERS[:3], Polygons(np.array([3]), np.array([0, 1, 2])))


@given(arrays(np.float64, (5, 3), elements=st.floats(-1e300, 1e300)))
def test_normals_get_unit_length_and_zero_rows_stay(normals):
    unit = scale_to_unit_length(normals)
    lengths = np.linalg.norm(unit, axis=1)
    zero = (normals == 0).all(axis=1)
    np.testing.assert_allclose(lengths[~zero], 1, rtol=1e-9)
    assert (unit[zero] == 0).all()
    assert ((unit * normals).sum(axis=1)[~zero] >= 0).all()


def test_normals_that_are_not_finite_are_reported():
    with pytest.raises(InputError, match="normals: 1 of 4 rows hold NaN"):
        assemble_shape(CORNERS, normals=[[0, 0, 1], [0, 0, np.inf], [0, 0, 0], [1, 0, 0]])


def test_whole_numbers():
    assert as_whole_numbers([1.0, -2.0], "labels").dtype == np.int64
    np.testing.assert_array_equal(as_whole_numbers(np.array([3], dtype=np.uint8), "labels"), [3])
    for bad in (1.5, np.nan, np.inf, 1e300):
        with pytest.raises(InputError, match="labels: expected whole numbers"):
            as_whole_numbers([1.0, bad], "labels")
