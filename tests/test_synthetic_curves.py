import numpy as np
import pytest

from morphoskel.datasets.synthetic import curves


@pytest.mark.parametrize(("normal", "expected"), [("x", [5, 2, 1]), ("y", [1, 5, 2]), ("z", [1, 2, 5])])
def test_embed_names_the_axes_of_the_plane(normal, expected):
    assert curves.embed([(1.0, 2.0)], normal, 5.0).tolist() == [expected]
    assert curves.embed([(1.0, 2.0)], normal, 5.0, (1.0, 1.0, 1.0)).tolist() == [[value + 1 for value in expected]]


def test_arc_lies_on_its_ellipse_and_has_its_ends():
    points = curves.arc((1.0, -1.0), (2.0, 0.5), (0.0, 90.0), 9)
    assert np.allclose(((points - (1.0, -1.0)) / (2.0, 0.5)) ** 2 @ [1, 1], 1.0)
    assert np.allclose(points[[0, -1]], [(3.0, -1.0), (1.0, -0.5)])


@pytest.mark.parametrize("exponent", [2.0, 3.5, 6.0])
def test_superellipse_fulfils_its_equation(exponent):
    points = curves.superellipse(2.0, 0.7, exponent, 40)
    assert np.allclose(np.abs(points[:, 0] / 2.0) ** exponent + np.abs(points[:, 1] / 0.7) ** exponent, 1.0)


def test_rounded_rectangle_has_its_extent_even_if_the_radius_is_too_large():
    for radius in (0.1, 5.0):
        points = curves.rounded_rectangle(2.0, 1.0, radius)
        assert np.allclose(np.ptp(points, axis=0), (2.0, 1.0))


def test_aerofoil_is_simple_and_nowhere_flat():
    points = curves.aerofoil(1.0, 0.2)
    assert len(np.unique(points, axis=0)) == len(points)
    upper, lower = points[1:7], points[7:][::-1]
    assert (upper[:, 1] > 0).all()
    assert (lower[:, 1] <= 0).all()


def test_smooth_path_starts_and_ends_where_it_should():
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0)]
    path = curves.smooth_path(corners, 30)
    assert path.shape == (30, 3)
    assert np.allclose(path[[0, -1]], [corners[0], corners[-1]])
    assert np.linalg.norm(path - (1.0, 0.0, 0.0), axis=1).min() < 0.1


def test_smooth_outline_is_closed_and_mirrored_outline_symmetric():
    outline = curves.mirrored_outline([(0.0, 0.0), (1.0, 0.5), (0.0, 1.0)])
    assert outline.tolist() == [[0.0, 0.0], [1.0, 0.5], [0.0, 1.0], [-1.0, 0.5]]
    smooth = curves.smooth_outline(outline, 40)
    steps = np.linalg.norm(np.roll(smooth, -1, axis=0) - smooth, axis=1)
    assert steps.max() < 3 * steps.min()
    assert np.allclose(np.sort(smooth[:, 0]), np.sort(-smooth[:, 0]), atol=1e-9)
