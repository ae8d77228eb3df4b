import numpy as np
import pytest
from scipy.spatial import KDTree
from solids import ball, box, capsule, torus

from morphoskel.errors import InputError, ShapeError
from morphoskel.formats import read_shape
from morphoskel.formats.medial_axis_file import read_medial_axis
from morphoskel.formats.sample import sample_surface
from morphoskel.shapes import Mesh
from morphoskel.skeleton.medial_axis import medial_axis, medial_axis_of_mesh
from morphoskel.skeleton.shrinking_balls import shrink_balls

MEASURED = {}


def axis_of(make):
    """Return the axis of a solid, computed once for all tests."""
    if make not in MEASURED:
        MEASURED[make] = medial_axis_of_mesh(make(), np.random.default_rng(1))
    return MEASURED[make]


def brick():
    return box(2.0, 1.5, 1.0)


def reach(points, others):
    """Distance from each point to the nearest of the others."""
    return KDTree(others).query(points)[0]


def test_a_ball_has_one_centre():
    axis = axis_of(ball)
    assert np.linalg.norm(axis.points, axis=1).max() < 0.05
    np.testing.assert_allclose(axis.radii, 1, atol=0.05)


def test_a_capsule_has_a_segment():
    axis = axis_of(capsule)  # radius 0.5 around the z axis from -1 to 1
    segment = np.column_stack([np.zeros((50, 2)), np.linspace(-1, 1, 50)])
    along = np.clip(axis.points[:, 2:], -1, 1)
    to_segment = np.linalg.norm(axis.points - along * [0, 0, 1], axis=1)
    assert to_segment.mean() < 0.02
    assert to_segment.max() < 0.05
    assert reach(segment, axis.points).max() < 0.05
    np.testing.assert_allclose(axis.radii, 0.5, atol=0.03)


def test_a_torus_has_a_circle():
    axis = axis_of(torus)  # tube of radius 0.3 around the unit circle
    turns = np.linspace(0, 2 * np.pi, 200)
    circle = np.column_stack([np.cos(turns), np.sin(turns), np.zeros(200)])
    to_circle = np.hypot(np.linalg.norm(axis.points[:, :2], axis=1) - 1, axis.points[:, 2])
    assert to_circle.mean() < 0.01
    assert to_circle.max() < 0.03
    assert reach(circle, axis.points).max() < 0.05
    np.testing.assert_allclose(axis.radii, 0.3, atol=0.02)


def face_distances(points):
    """Distances to the six faces of the brick, smallest first."""
    half = np.array([1.0, 0.75, 0.5])
    return np.sort(np.hstack([half - points, half + points]), axis=1)


def test_a_box_has_the_sheets_between_its_faces():
    axis = axis_of(brick)
    nearest = face_distances(axis.points)
    assert np.quantile(nearest[:, 1] - nearest[:, 0], 0.99) < 0.03
    assert np.abs(nearest[:, 0] - axis.radii).mean() < 0.005
    inner = np.random.default_rng(2).uniform(-1, 1, (400_000, 3)) * [1, 0.75, 0.5]
    nearest = face_distances(inner)
    on_sheets = inner[(nearest[:, 1] - nearest[:, 0] < 0.005) & (nearest[:, 0] > 0.05)]
    assert len(on_sheets) > 1000
    assert reach(on_sheets, axis.points).max() < 0.15
    assert reach(on_sheets, axis.points).mean() < 0.03


def test_pruning_by_angle_leaves_the_sheet_between_opposite_faces():
    """The sheets to the edges have 90 degrees, the middle one 180; near the edges samples are too sparse to tell."""
    axis = medial_axis_of_mesh(brick(), np.random.default_rng(1), separation_angle=120, scale=0.1)
    assert np.abs(axis.points[:, 2]).max() < 0.06
    assert np.abs(axis_of(brick).points[:, 2]).max() > 0.4


def test_pruning_by_scale_leaves_balls_whose_touching_points_are_apart():
    cloud = sample_surface(brick(), 5000, np.random.default_rng(3))
    balls = shrink_balls(cloud.points, cloud.normals)
    axis = medial_axis(cloud.points, cloud.normals, scale=0.25, separation_angle=0, gap=0, count=5000)
    diagonal = np.linalg.norm(np.ptp(cloud.points, axis=0))
    kept = balls.centres[balls.chords >= 0.25 * diagonal]
    assert 0 < len(kept) < len(balls.centres)
    assert {*map(tuple, axis.points)} == {*map(tuple, kept)}


def test_any_first_part_covers_the_axis_evenly():
    axis = axis_of(brick)
    assert len(axis) == 2048
    assert axis.radii[0] == axis.radii.max()
    fewer = medial_axis_of_mesh(brick(), np.random.default_rng(1), count=200)
    np.testing.assert_array_equal(fewer.points, axis.points[:200])
    assert KDTree(fewer.points).query(fewer.points, k=2)[0][:, 1].min() >= reach(axis.points, fewer.points).max()
    apart = medial_axis_of_mesh(brick(), np.random.default_rng(1), gap=0.1)
    diagonal = np.linalg.norm([2, 1.5, 1])
    assert KDTree(apart.points).query(apart.points, k=2)[0][:, 1].min() > 0.099 * diagonal
    assert reach(axis.points, apart.points).max() < 0.1 * diagonal


def test_moves_and_scales_with_the_shape():
    cloud = sample_surface(torus(), 3000, np.random.default_rng(4))
    before = medial_axis(cloud.points, cloud.normals, count=100)
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    after = medial_axis(8 * cloud.points @ turn.T + 1, cloud.normals @ turn.T, count=100)
    np.testing.assert_allclose(reach(after.points, 8 * before.points @ turn.T + 1), 0, atol=0.3)
    assert abs(after.radii.mean() - 8 * before.radii.mean()) < 0.05


def test_the_same_generator_gives_the_same_axis():
    first, second = (medial_axis_of_mesh(torus(), np.random.default_rng(5), samples=2000) for _ in range(2))
    np.testing.assert_array_equal(first.points, second.points)


def test_a_surface_turned_inside_out_is_refused():
    solid = ball()
    with pytest.raises(ShapeError, match=r"none of the 0 balls of 500 samples .*normals point outward"):
        medial_axis_of_mesh(Mesh(solid.vertices, solid.triangles[:, ::-1]), np.random.default_rng(6), samples=500)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"separation_angle": 190}, "separation_angle: expected degrees from 0 to 180, got 190"),
        ({"scale": -0.1}, "scale: expected a share of the diagonal"),
        ({"gap": 1}, "gap: expected a share of the diagonal"),
        ({"tolerance": 1}, "tolerance: expected a share of the radius"),
        ({"count": 0}, "count: expected at least 1"),
        ({"samples": 3}, "samples: expected at least 4"),
    ],
)
def test_illegal_settings_are_named(settings, message):
    with pytest.raises(InputError, match=message):
        medial_axis_of_mesh(brick(), np.random.default_rng(7), **{"samples": 500, **settings})


def dense(axis):
    """Return an axis as a cloud: its vertices, and samples of its triangles."""
    triangles = Mesh(axis.points, axis.triangles)
    return np.vstack([axis.points, sample_surface(triangles, 20_000, np.random.default_rng(8)).points])


def test_the_published_axes_of_a_dog(real_data):
    """Means as shares of the dog's longest side; that from MATFP to ours is larger, since MATFP is hardly pruned."""
    folder = real_data / "medial_axis"
    dog = read_shape(folder / "dog.off")
    axis = medial_axis_of_mesh(dog, np.random.default_rng(9), count=20_000)
    lower, upper = dog.bounds
    matfp = dense(read_medial_axis(folder / "dog_matfp.ma")) * (upper - lower).max() / 10 + (lower + upper) / 2
    qmat = dense(read_medial_axis(folder / "dog_qmat.ma"))
    assert reach(axis.points, matfp).mean() < 0.003
    assert reach(matfp, axis.points).mean() < 0.008
    assert reach(qmat, axis.points).mean() < 0.008  # Q-MAT is simplified: its sheets are a part of ours
