import numpy as np
import pytest

from morphoskel.skeleton.dpc import DeepPointsSettings
from morphoskel.skeleton.dpc.sinking import meet_fronts, sink

SETTINGS = DeepPointsSettings()


def unit_rows(rows):
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def grid(count, spacing):
    plane = spacing * np.indices((count, count)).reshape(2, -1).T
    return np.column_stack([plane, np.zeros(len(plane))])


def plates(gap, count=9):
    """Return two facing grids of spacing 1, and their outward normals."""
    lower = grid(count, 1.0)
    samples = np.vstack([lower, lower + np.array([0.0, 0.0, gap])])
    return samples, np.repeat([[0.0, 0, -1], [0, 0, 1]], len(lower), axis=0)


@pytest.mark.parametrize("separation", [0.0, 0.3])
def test_meeting_matches_all_pairs(separation):
    rng = np.random.default_rng(2)
    samples, directions = rng.random((150, 3)), unit_rows(rng.normal(size=(150, 3)))
    depths, moving = 0.4 * rng.random(150), rng.random(150) < 0.8
    inner = samples - depths[:, None] * directions
    near = np.linalg.norm(inner[:, None] - inner, axis=2) <= 0.15
    apart = np.linalg.norm(samples[:, None] - samples, axis=2) >= separation
    angles = np.degrees(np.arccos(np.clip(directions @ directions.T, -1, 1)))
    expected = moving & (near & apart & (angles > 45.0) & ~np.eye(150, dtype=bool)).any(axis=1)
    assert 0 < expected.sum() < moving.sum()
    met = meet_fronts(samples, directions, depths, moving, separation, 0.1, SETTINGS)
    np.testing.assert_array_equal(met, expected)


def test_facing_plates_stop_within_the_stop_radius_of_each_other():
    samples, directions = plates(10.0)
    sinking = sink(samples, directions, 1.0, SETTINGS)
    assert sinking.stopped.all()
    gaps = 10.0 - 2 * sinking.depths
    assert (gaps <= SETTINGS.stop_radius).all()
    assert (gaps > SETTINGS.stop_radius - 4 * SETTINGS.step).all()


def test_an_open_sheet_never_stops():
    samples, directions = plates(10.0)
    sinking = sink(samples[:81], directions[:81], 1.0, DeepPointsSettings(max_steps=20))
    assert not sinking.stopped.any()
    np.testing.assert_allclose(sinking.depths, 21 * SETTINGS.step)  # the untested step and 20 more


def test_untested_steps_free_the_points_beside_an_edge():
    floor = grid(9, 1.0)
    wall = floor[:, [2, 1, 0]] + np.array([0.0, 0.0, 1.0])  # a concave right angle at x = 0, z = 0
    samples = np.vstack([floor, wall])
    directions = np.repeat([[0.0, 0, 1], [1, 0, 0]], len(floor), axis=0)
    beside = np.concatenate([floor[:, 0] == 0, wall[:, 2] == 1])
    depths = [
        sink(samples, directions, 1.0, DeepPointsSettings(untested_steps=steps, max_steps=10)).depths[beside]
        for steps in (0, 1, 5)
    ]
    np.testing.assert_array_equal(depths[0], 0.0)
    np.testing.assert_allclose(depths[1], SETTINGS.step)
    assert (depths[2] > 1.0).all()


def test_motion_cools_down_beside_points_that_stopped():
    lower = grid(9, 1.0)
    samples = np.vstack([lower, [[4.0, 4.0, -2.0]]])  # one opposite sample, which stops the middle of the sheet only
    directions = np.vstack([np.repeat([[0.0, 0, 1]], 81, axis=0), [[0.0, 0, -1]]])
    free = sink(samples, directions, 1.0, DeepPointsSettings(cooling=0.0, max_steps=30))
    cooled = sink(samples, directions, 1.0, DeepPointsSettings(cooling=0.97, max_steps=30))
    assert 0 < free.stopped.sum() < cooled.stopped.sum()


def test_a_lonely_sample_keeps_its_speed():
    samples, directions = plates(10.0)
    samples, directions = np.vstack([samples, [[90.0, 0, 0]]]), np.vstack([directions, [[1.0, 0, 0]]])
    sinking = sink(samples, directions, 1.0, DeepPointsSettings(max_steps=50))
    np.testing.assert_allclose(sinking.depths[-1], 51 * SETTINGS.step)
