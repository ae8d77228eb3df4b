from dataclasses import replace

import numpy as np
import pytest
from illustrated import illustrated

from morphoskel.reporting.figures.section_view import largest_distance, largest_residue, section_view
from morphoskel.shapes import Mesh


def test_the_camera_looks_along_the_shorter_horizontal_side():
    box = illustrated("box")
    turned = replace(box, surface=Mesh(box.surface.vertices[:, [2, 1, 0]], box.surface.triangles))
    for illustration, axis in ((box, 2), (turned, 0)):
        view = section_view(illustration, 50)
        assert view.axis == axis
        assert np.abs(view.view.axes()[2]).argmax() == axis
        assert view.view.axes()[2][axis] > 0


def test_the_cut_runs_through_the_thickest_place_and_leaves_the_far_half():
    torus = illustrated("torus")
    view = section_view(torus, 50)
    behind = view.behind(torus.inner)
    assert abs(view.place) < 0.1
    assert behind[torus.udf.argmax()]
    assert 0.3 < behind.mean() < 0.7
    towards = torus.inner @ view.view.axes()[2]
    assert towards[behind].mean() < towards[~behind].mean()


def test_a_cut_shows_the_inside_that_the_whole_hides():
    torus = illustrated("torus")
    view = section_view(torus, 60)
    red_inside = np.where(torus.udf[:, None] > 0.2, [1.0, 0, 0], [0, 0, 1.0])
    red = [(view.draw_inner(torus, red_inside, cut=cut)[..., 0] > 0.3).mean() for cut in (True, False)]
    blue = [(picture[..., 2] > picture[..., 0] + 0.2).mean() for picture in
            (view.draw_inner(torus, red_inside, cut=cut) for cut in (True, False))]  # fmt: skip
    assert blue[0] < 0.8 * blue[1]
    assert red[0] > 0


def test_points_turn_paler_with_their_distance():
    view = section_view(illustrated("box"), 50)
    near, far = view.by_depth(np.stack([view.view.axes()[2], -view.view.axes()[2]]))
    assert (near < far).all()


def test_pictures_of_one_view_are_aligned():
    torus = illustrated("torus")
    view = section_view(torus, 60)
    pictures = [
        view.draw_distances(torus, torus.udf, largest_distance(torus)),
        view.draw_distances(torus, torus.dilated, largest_distance(torus)),
        view.draw_residues(torus, largest_residue(torus)),
    ]
    shapes = [(picture < 1).any(axis=2) for picture in pictures]
    assert all(np.array_equal(shape, shapes[0]) for shape in shapes)
    assert not np.array_equal(pictures[0], pictures[1])


def test_points_selected_shine_through_the_surface():
    torus = illustrated("torus")
    view = section_view(torus, 60)
    picture = view.draw_selected(torus, largest_distance(torus))
    assert (np.ptp(picture, axis=2) > 0.3).any()


def test_scales_end_at_the_largest_distance_and_near_the_largest_residue():
    box, torus = illustrated("box"), illustrated("torus")
    assert largest_distance(box, torus) == pytest.approx(max(box.udf.max(), torus.udf.max()))
    assert (box.residues <= largest_residue(box)).mean() == pytest.approx(0.98, abs=0.01)
