import numpy as np
import pytest
from solids import ball

from morphoskel.errors import InputError
from morphoskel.exporting.coloured_parts import TRIANGLE_LIMIT, coloured_parts
from morphoskel.shapes import Mesh, Skeleton

POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
FULL = Skeleton(POINTS, [0.0, 0.2, 0.1, 0.4], edges=[[0, 3]], triangles=[[0, 1, 2]])


def test_every_part_of_a_skeleton_and_its_surface():
    parts = {part.name: part for part in coloured_parts(FULL, ball(subdivisions=1), subdivisions=1)}
    assert list(parts) == ["balls", "sheets", "curves", "surface"]
    assert len(parts["balls"].vertices) == 3 * 42  # the ball of radius 0 is left out
    assert [part.elements.shape[1] for part in parts.values()] == [3, 3, 2, 3]
    assert [name for name, part in parts.items() if part.translucent] == ["surface"]
    for part in parts.values():
        assert part.colours.shape == (len(part.vertices), 4)


def test_balls_are_coloured_from_dark_blue_at_zero_to_yellow_at_the_largest():
    [balls] = coloured_parts(Skeleton(POINTS[:3], [1e-9, 0.5, 1.0]), subdivisions=0)
    first, middle, last = balls.colours[[0, 12, 24]].tolist()
    assert first == [68, 1, 84, 255]
    assert last == [253, 231, 37, 255]
    assert middle == [33, 145, 140, 255]
    np.testing.assert_array_equal(balls.colours, np.repeat(balls.colours[::12], 12, axis=0))  # one colour a ball


def test_normals_point_away_from_the_centres():
    [balls, *_] = coloured_parts(Skeleton([[5.0, 0, 0]], [0.5]), subdivisions=2)
    np.testing.assert_allclose(balls.normals, (balls.vertices - [5, 0, 0]) / 0.5, atol=1e-12)


def test_normals_have_unit_length_even_where_triangles_give_no_direction():
    sliver_and_spare = Mesh(np.vstack([np.eye(3), [[2.0, 2, 2]]]), [[0, 1, 2], [0, 0, 1]])
    folded = Skeleton(POINTS, np.ones(4), triangles=[[0, 1, 2], [2, 1, 0]])
    for part in coloured_parts(folded, sliver_and_spare, subdivisions=0):
        np.testing.assert_allclose(np.linalg.norm(part.normals, axis=1), 1, atol=1e-9)


def test_sheets_and_curves_have_no_vertices_to_spare():
    parts = {part.name: part for part in coloured_parts(FULL)}
    np.testing.assert_array_equal(parts["curves"].vertices, POINTS[[0, 3]])
    np.testing.assert_array_equal(parts["curves"].elements, [[0, 1]])
    np.testing.assert_array_equal(parts["sheets"].vertices[parts["sheets"].elements], POINTS[[[0, 1, 2]]])


def test_many_balls_get_fewer_triangles_each():
    few, many = (coloured_parts(Skeleton(np.zeros((n, 3)), np.ones(n)))[0] for n in (10, 2000))
    assert len(few.elements) == 10 * 5120
    assert len(many.elements) == 2000 * 80 <= TRIANGLE_LIMIT


def test_curves_alone_can_be_shown_and_nothing_at_all_is_refused():
    parts = coloured_parts(Skeleton(POINTS, np.zeros(4), edges=[[0, 1]]))
    assert [part.name for part in parts] == ["curves"]
    with pytest.raises(InputError, match="4 balls, all of radius 0"):
        coloured_parts(Skeleton(POINTS, np.zeros(4)))
    with pytest.raises(InputError, match="0 balls"):
        coloured_parts(Skeleton(np.empty((0, 3)), []))
