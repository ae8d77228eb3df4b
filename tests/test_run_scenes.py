import dataclasses
import logging

import numpy as np
import pytest
from small_run import SURFACES, write_shapes

from morphoskel.chain.status import read_status, write_status
from morphoskel.datasets.manifest import first_of_each_category, read_manifest
from morphoskel.errors import InputError
from morphoskel.formats import read_skeleton_ply
from morphoskel.reporting.page import run_scenes as module
from morphoskel.reporting.page.run_scenes import run_scenes


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    root = tmp_path_factory.mktemp("scenes")
    return write_shapes(root, root / "run")


@pytest.fixture(scope="module")
def scenes(sources):
    return run_scenes(sources)


def layer(scene, start):
    [found] = [layer for layer in scene.layers if layer.name.startswith(start)]
    return found


def test_one_shape_a_category_without_those_that_failed(sources, scenes):
    assert len(first_of_each_category(read_manifest(sources.manifest))) == 3
    assert [scene.name for scene in scenes] == ["Ball", "Box"]


def test_layers_from_the_cloud_to_the_points_chosen(scenes):
    for scene in scenes:
        assert [(layer.name, layer.visible) for layer in scene.layers] == [
            ("cloud", False), ("closed surface", True), ("inner points, by residue", False), ("balls of MS3D", True),
            ("points of MS3D", True), ("points of FPS", False),
        ]  # fmt: skip
        assert layer(scene, "cloud").detail.startswith(f"{scene.name}-b, ")


def test_inner_points_lie_inside_and_have_the_residues_of_the_chain(sources, scenes):
    inner = layer(scenes[1], "inner")
    lower, upper = SURFACES["Box"].bounds
    assert (inner.positions > lower).all()
    assert (inner.positions < upper).all()
    folders = {stage: folders[0] for stage, folders in sources.inner.items()}
    expected = np.load(folders["dilation"] / "Box-b.npy") - np.load(folders["udf"] / "Box-b.npy")
    [scalar] = inner.scalars
    np.testing.assert_array_equal(scalar.values, expected)
    # The skeleton is made of the points with the least residues.
    balls = read_skeleton_ply(sources.skeletons[0] / "Box-b.ply")
    places = [np.flatnonzero((inner.positions == point).all(axis=1)) for point in balls.points.astype(np.float32)]
    chosen = np.concatenate(places)
    assert len(chosen) == len(balls) == 32
    assert scalar.values[chosen].max() <= np.delete(scalar.values, chosen).min()


def test_many_inner_points_are_thinned_out_evenly(sources, scenes, monkeypatch):
    monkeypatch.setattr(module, "INNER_POINTS", 100)
    all_points = layer(scenes[0], "inner")
    thinned = layer(run_scenes(sources)[0], "inner")
    step = -(-len(all_points.positions) // 100)
    assert step > 1
    np.testing.assert_array_equal(thinned.positions, all_points.positions[::step])
    np.testing.assert_array_equal(thinned.scalars[0].values, all_points.scalars[0].values[::step])
    assert thinned.scalars[0].limits == all_points.scalars[0].limits


def test_a_run_that_kept_less_shows_less(sources):
    bare = dataclasses.replace(sources, inner={}, clouds=None, samples={}, method="MS3D, repaired Poisson")
    [first, _] = run_scenes(bare)
    assert [layer.name for layer in first.layers] == ["cloud", "closed surface", "balls of MS3D, repaired Poisson"]


def test_shapes_and_bytes_are_bounded(sources, monkeypatch, caplog):
    monkeypatch.setattr(module, "MOST_SHAPES", 1)
    assert [scene.name for scene in run_scenes(sources)] == ["Ball"]
    monkeypatch.setattr(module, "MOST_SHAPES", 8)
    monkeypatch.setattr(module, "MOST_BYTES", 1000)
    with caplog.at_level(logging.WARNING):
        assert [scene.name for scene in run_scenes(sources)] == ["Ball"]
    assert "Box-b and what follows is left out" in caplog.text


def test_a_run_without_skeletons_is_refused(sources, tmp_path):
    rows = [dataclasses.replace(row, status="failed") for row in read_status(sources.skeletons[0])]
    write_status(tmp_path, rows)
    with pytest.raises(InputError, match="no shape has a skeleton"):
        run_scenes(dataclasses.replace(sources, skeletons=[tmp_path]))
