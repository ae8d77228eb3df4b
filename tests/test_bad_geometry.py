"""Shapes that are no clean solids near the origin: the right skeleton, or one clear error that names the file."""

import numpy as np
import pytest
from solids import ball, box, capsule, joined, sphere_cloud

from morphoskel.cli import main
from morphoskel.errors import InputError, MorphoSkelError, ShapeError
from morphoskel.formats import read_skeleton_ply, write_mesh_ply
from morphoskel.methods import SURFACE_METHODS
from morphoskel.shapes import Mesh, PointCloud
from morphoskel.skeletonization import skeletonize_shape
from morphoskel.surface import watertight
from morphoskel.volume import SurfaceDistance

FAST = {
    "candidates": {"mode": "random", "count": 8000},
    "k": 20,
    "points": 24,
    "seed": 3,
    "threads": 1,
    "watertight_settings": {"resolution": 1000},
}
FAST_WORDS = [
    "skeleton.candidates.count=8000",
    "skeleton.points=24",
    "surface.poisson.depth=5",
    "surface.repaired_poisson.depth=5",
    "watertight.resolution=1000",
]
TOLERANCE = 0.1
"""Of radii and places, in radii of the shape: candidates are few here."""


def skeleton_of(shape, **changes):
    return skeletonize_shape(shape, **{**FAST, "method": "ms3d", **changes}).skeleton


def moved(mesh, scale=1.0, offset=(0.0, 0.0, 0.0)):
    return Mesh(mesh.vertices * scale + np.array(offset), mesh.triangles)


def assert_same_balls(skeleton, expected, scale=1.0, offset=0.0, tolerance=TOLERANCE):
    """Compare as sets, for ties between equal residues may be broken the other way."""
    places = (skeleton.points - offset) / scale
    gaps = np.linalg.norm(places[:, None] - expected.points[None], axis=2).min(axis=1)
    assert gaps.max() < tolerance
    assert abs(skeleton.radii.max() / scale - expected.radii.max()) < tolerance


def assert_inside(skeleton, mesh, tolerance=TOLERANCE):
    """Every ball must lie inside the surface, and the largest must be no mere speck."""
    distances = SurfaceDistance(mesh)(skeleton.points.astype(np.float32))
    assert (skeleton.radii <= distances + tolerance).all()
    lower, upper = mesh.bounds
    assert ((skeleton.points > lower - 1e-6) & (skeleton.points < upper + 1e-6)).all()


@pytest.fixture(scope="module")
def of_capsule():
    return skeleton_of(capsule())


@pytest.mark.parametrize("power", [-20, 20])
def test_a_power_of_two_as_scale_changes_no_other_bit(power, of_capsule):
    skeleton = skeleton_of(moved(capsule(), 2.0**power))
    np.testing.assert_array_equal(skeleton.points, of_capsule.points * 2.0**power)
    np.testing.assert_array_equal(skeleton.radii, of_capsule.radii * 2.0**power)


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_skeletons_scale_with_the_shape(scale, of_capsule):
    assert_same_balls(skeleton_of(moved(capsule(), scale)), of_capsule, scale)


@pytest.mark.parametrize("offset", [(1e6, 0, 0), (-1e6, 1e6, 1e6), (100, 0, 0)])
def test_skeletons_move_with_the_shape_however_far(offset, of_capsule):
    assert_same_balls(skeleton_of(moved(capsule(), offset=offset)), of_capsule, offset=np.array(offset))


def test_clouds_far_from_the_origin_are_moved_too():
    cloud = sphere_cloud(400)
    near, far = (
        skeleton_of(PointCloud(cloud.points + offset, cloud.normals), reconstruction={"depth": 4})
        for offset in (0.0, 1e6)
    )
    assert_same_balls(far, near, offset=1e6)
    assert near.radii.max() > 0.8


def test_the_workflows_conversion_refuses_what_single_precision_cannot_hold():
    with pytest.raises(ShapeError, match=r"times its extent from the origin.*move it nearer"):
        watertight(moved(ball(subdivisions=2), offset=(1e6, 0, 0)), seed=1, resolution=1000)


def inside_out(mesh):
    return Mesh(mesh.vertices, mesh.triangles[:, ::-1])


def test_inside_out_is_the_same_shape(of_capsule):
    assert_same_balls(skeleton_of(inside_out(capsule())), of_capsule)


def test_repeated_vertices_and_triangles_change_nothing(of_capsule):
    mesh = capsule()
    soup = mesh.vertices[mesh.triangles].reshape(-1, 3)
    numbers = np.arange(len(soup)).reshape(-1, 3)
    assert_same_balls(skeleton_of(Mesh(soup, np.vstack([numbers, numbers[:50]]))), of_capsule)


def test_an_open_vessel_is_closed():
    mesh = ball(subdivisions=3)
    high = mesh.vertices[mesh.triangles][:, :, 2].max(axis=1) > 0.95
    skeleton = skeleton_of(Mesh(mesh.vertices, mesh.triangles[~high]))
    assert_inside(skeleton, mesh)


def crossing_boxes():
    return joined([box(2, 0.6, 0.6), box(0.6, 2, 0.6)])


def fan_of_boxes():
    """Two boxes that share an edge: four triangles meet there."""
    return joined([box(1, 1, 1), moved(box(1, 1, 1), offset=(1, 1, 0))])


@pytest.mark.parametrize("mesh", [crossing_boxes(), fan_of_boxes()], ids=["self-intersecting", "non-manifold"])
def test_the_union_counts(mesh):
    skeleton = skeleton_of(mesh)
    lower, upper = mesh.bounds
    assert ((skeleton.points > lower) & (skeleton.points < upper)).all()
    half = 0.3 if len(mesh.vertices) and upper[0] == 1.0 and lower[1] == -1.0 else 0.5
    assert skeleton.radii.max() == pytest.approx(half, abs=TOLERANCE)


@pytest.mark.parametrize("inner", [ball(0.5, 3), inside_out(ball(0.5, 3))], ids=["solid", "cavity"])
def test_what_a_component_encloses_counts_as_solid(inner):
    """The paper's conversion to a closed surface sees a shape from outside; it fills cavities."""
    skeleton = skeleton_of(joined([ball(1.0, 3), inner]))
    assert_inside(skeleton, ball(1.0, 3))
    assert skeleton.radii.max() == pytest.approx(1, abs=TOLERANCE)


def test_components_apart_have_balls_each():
    skeleton = skeleton_of(joined([ball(1.0, 3), moved(ball(1.0, 3), offset=(5, 0, 0))]))
    assert (skeleton.points[:, 0] < 2).any()
    assert (skeleton.points[:, 0] > 3).any()
    assert skeleton.radii.max() == pytest.approx(1, abs=TOLERANCE)


GRID = np.stack(np.meshgrid(np.arange(12.0), np.arange(12.0)), axis=-1).reshape(-1, 2)

BAD_CLOUDS = {
    "collinear": np.arange(60.0)[:, None] * [1.0, 2.0, 3.0],
    "coplanar": np.column_stack([GRID, np.zeros(len(GRID))]),
    "four_points": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]),
}


def outcome(shape, method):
    """Return the skeleton, or the project's own error; any other escapes."""
    try:
        changes = {"reconstruction": {"depth": 4}} if method in SURFACE_METHODS else {}
        return skeleton_of(shape, method=method, **changes)
    except MorphoSkelError as error:
        return error


@pytest.mark.parametrize("method", ["ms3d", "ms3d_coverage", "coverage_axis", "dpc", "l1_medial"])
@pytest.mark.parametrize("name", BAD_CLOUDS)
def test_clouds_without_volume_give_balls_or_one_clear_error(name, method):
    found = outcome(PointCloud(BAD_CLOUDS[name]), method)
    if isinstance(found, MorphoSkelError):
        assert "point" in str(found) or "surface" in str(found)
    else:
        assert len(found) > 0
        assert found.radii.max() <= np.ptp(BAD_CLOUDS[name], axis=0).max()


def test_repeated_points_change_nothing_that_matters():
    cloud = sphere_cloud(300)
    thrice = PointCloud(np.repeat(cloud.points, 3, axis=0), np.repeat(cloud.normals, 3, axis=0))
    assert skeleton_of(thrice, reconstruction={"depth": 4}).radii.max() > 0.8


@pytest.mark.parametrize("count", [0, 1, 3])
def test_too_few_points_are_refused_at_once(count):
    with pytest.raises(InputError, match="at least 4 distinct points"):
        PointCloud(np.arange(3.0 * count).reshape(count, 3))


def test_a_million_equal_points_are_refused_at_once():
    with pytest.raises(InputError, match="1000000 points, 1 of them distinct"):
        PointCloud(np.ones((1_000_000, 3)))


def test_the_command_names_every_file_that_fails(tmp_path, capfd):
    bad = {
        "empty.ply": b"",
        "no_points.ply": b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
        b"property float z\nend_header\n",
        "one_point.xyz": b"0 0 0\n",
        "infinite.xyz": b"0 0 0\n1 0 0\n0 1 0\n0 0 inf\n",
        "flat.off": b"OFF\n4 2 0\n0 0 0\n0 0 0\n0 0 0\n1 1 1\n3 0 1 2\n3 1 2 0\n",
        "vast.xyz": b"0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n1e300 1e300 1e300\n",
    }
    for name, content in bad.items():
        (tmp_path / name).write_bytes(content)
    write_mesh_ply(tmp_path / "good.ply", ball(subdivisions=3))
    assert main(["skeletonize", str(tmp_path), "-o", str(tmp_path / "out"), "--method", "ms3d", *FAST_WORDS]) == 1
    log = capfd.readouterr().err
    assert "unexpected error" not in log
    for name in bad:
        assert f"{name}: FAILED" in log
    assert len(read_skeleton_ply(tmp_path / "out" / "good.ply")) == 24


@pytest.mark.slow
def test_a_mesh_of_a_million_triangles():
    mesh = ball(subdivisions=8)
    assert len(mesh.triangles) > 1_000_000
    skeleton = skeleton_of(mesh)
    assert skeleton.radii.max() == pytest.approx(1, abs=TOLERANCE)
    assert_inside(skeleton, mesh)
