import numpy as np
import pytest
from coloured import SKELETON
from solids import ball, sphere_cloud

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply, write_mesh_ply, write_skeleton_npz, write_skeleton_ply
from morphoskel.reporting.scene_files import scenes_of_files
from morphoskel.shapes import Skeleton

CLOUD = sphere_cloud(50)
SAMPLE = {
    "indices": np.array([3, 1, 40, 7]),
    "points": CLOUD.points[[3, 1, 40, 7]],
    "local_feature_size": np.linspace(0, 1, 50),
    "skeleton_points": SKELETON.points,
    "skeleton_radii": SKELETON.radii,
}


@pytest.fixture
def folder(tmp_path):
    for name in ("in", "out"):
        (tmp_path / name).mkdir()
    write_skeleton_ply(tmp_path / "out" / "a.ply", SKELETON)
    write_cloud_ply(tmp_path / "in" / "a.ply", CLOUD)
    write_mesh_ply(tmp_path / "in" / "b.ply", ball(subdivisions=1))
    np.savez(tmp_path / "out" / "c.npz", **SAMPLE)
    np.savez(tmp_path / "in" / "c.npz", points=CLOUD.points)
    return tmp_path


def kinds(scene):
    return {layer.name: layer.kind for layer in scene.layers}


def test_files_of_one_name_share_a_scene(folder):
    first, second = scenes_of_files([folder / "out" / "a.ply", folder / "in" / "b.ply", folder / "in" / "a.ply"])
    assert (first.name, second.name) == ("a", "b")
    assert kinds(first) == {
        "skeleton": "balls", "skeleton, sheets": "mesh", "skeleton, curves": "segments", "cloud": "points"
    }  # fmt: skip
    assert kinds(second) == {"surface": "mesh"}


def test_a_surface_is_translucent_only_around_something(folder):
    [alone] = scenes_of_files([folder / "in" / "b.ply"])
    assert [layer.opacity for layer in alone.layers] == [1.0]
    [both] = scenes_of_files([folder / "in" / "b.ply", folder / "in" / "a.ply"], together=True)
    assert both.name == "b"
    assert [layer.opacity for layer in both.layers if layer.kind == "mesh"] == [0.2]


def test_files_of_one_kind_are_called_by_what_sets_them_apart(folder):
    bare = Skeleton(SKELETON.points, SKELETON.radii)
    paths = [folder / "one" / "run" / "a.ply", folder / "two" / "run" / "a.ply", folder / "two" / "run" / "a.npz"]
    for path, write in zip(paths, (write_skeleton_ply, write_skeleton_ply, write_skeleton_npz), strict=True):
        write(path, bare)
    [scene] = scenes_of_files([*paths[:2], folder / "in" / "a.ply"])
    assert list(kinds(scene)) == ["skeleton one/run", "skeleton two/run", "cloud"]
    assert [layer.visible for layer in scene.layers] == [True, False, True]  # the others would hide each other
    [scene] = scenes_of_files(paths[1:])
    assert list(kinds(scene)) == ["skeleton a.ply", "skeleton a.npz"]
    [scene] = scenes_of_files([paths[0], folder / "in" / "b.ply"], together=True)
    assert list(kinds(scene)) == ["a.ply", "b.ply"]


def test_the_view_is_passed_on(folder):
    [scene] = scenes_of_files([folder / "in" / "b.ply"], up="z", azimuth=235)
    assert (scene.up, scene.azimuth) == ("z", 235)


def test_chosen_points_colour_their_cloud_by_its_local_feature_size(folder):
    [scene] = scenes_of_files([folder / "out" / "c.npz", folder / "in" / "c.npz"])
    chosen, skeleton, cloud = scene.layers
    assert (chosen.name, skeleton.name, cloud.name) == ("chosen points", "chosen points, skeleton", "cloud")
    assert (chosen.visible, skeleton.visible, cloud.visible) == (True, False, True)
    np.testing.assert_array_equal(chosen.scalars[0].values, SAMPLE["local_feature_size"][SAMPLE["indices"]])
    np.testing.assert_array_equal(cloud.scalars[0].values, SAMPLE["local_feature_size"])
    assert chosen.scalars[0].limits == cloud.scalars[0].limits


def test_the_sizes_of_another_cloud_are_not_its_own(folder):
    np.savez(folder / "in" / "c.npz", points=CLOUD.points[::-1])
    [scene] = scenes_of_files([folder / "out" / "c.npz", folder / "in" / "c.npz"])
    assert scene.layers[-1].scalars == ()


def test_points_chosen_on_a_mesh_bring_their_cloud(folder):
    np.savez(folder / "d.npz", **SAMPLE, cloud=CLOUD.points)
    [scene] = scenes_of_files([folder / "d.npz"])
    assert kinds(scene)["chosen points, cloud"] == "points"
    bare = {name: SAMPLE[name] for name in ("indices", "points")}
    np.savez(folder / "e.npz", **bare)
    [scene] = scenes_of_files([folder / "e.npz"])
    assert kinds(scene) == {"chosen points": "points"}


def test_skeletons_and_medial_axes_of_every_format(folder):
    write_skeleton_npz(folder / "f.npz", SKELETON)
    (folder / "g.ma").write_text("2 1 0\nv 0 0 0 1\nv 1 0 0 0.5\ne 0 1\n")
    arrays, axis = scenes_of_files([folder / "f.npz", folder / "g.ma"])
    assert kinds(arrays) == {"skeleton": "balls", "skeleton, sheets": "mesh", "skeleton, curves": "segments"}
    assert kinds(axis) == {"skeleton": "balls", "skeleton, curves": "segments"}


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ([], "expected at least one file"),
        (["gone.ply"], r"gone\.ply: cannot be read"),
        (["in"], r"in: is a folder; name the files in it"),
        (["in/a.ply", "in/../in/a.ply"], r"a\.ply: named twice"),
        (["a.txt.bak"], r"unknown format '\.bak'"),
    ],
)
def test_files_that_cannot_be_shown(folder, names, message):
    with pytest.raises(InputError, match=message):
        scenes_of_files([folder / name for name in names])


@pytest.mark.parametrize(
    "changes",
    [
        {"indices": np.array([3, 1, 50, 7])},
        {"indices": np.array([3, 1])},
        {"local_feature_size": np.eye(2)},
        {"points": np.eye(2)},
        {"skeleton_radii": np.ones(2)},
    ],
)
def test_chosen_points_whose_arrays_do_not_fit(folder, changes):
    np.savez(folder / "bad.npz", **{**SAMPLE, **changes})
    with pytest.raises(InputError, match=r"bad\.npz: "):
        scenes_of_files([folder / "bad.npz"])
