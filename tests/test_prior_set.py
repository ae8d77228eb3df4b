import math

import numpy as np
import pytest
from tiny_clouds import select, tiny_clouds, tiny_priors

from morphoskel.chain.status import Status, write_status
from morphoskel.errors import InputError, ShapeError
from morphoskel.formats import write_skeleton_ply
from morphoskel.sampling.prior_set import (
    check_priors,
    measure_local_feature_sizes,
    read_prior_set,
    write_prior_set,
)
from morphoskel.shapes import Skeleton

CLOUDS = tiny_clouds(shapes=5, points=12)
FAILED = "s3"


def skeleton_of(number):
    """Return four centres in the original frame of the clouds, where they are around (5, 5, 5)."""
    return np.random.default_rng(number).normal(size=(4, 3)) / 4 + 5


@pytest.fixture
def folders(tmp_path):
    """Two shards of skeletons; one shape has none."""
    paths = [tmp_path / "00000", tmp_path / "00001"]
    for shard, path in enumerate(paths):
        path.mkdir()
        rows = []
        for number in range(shard, 5, 2):
            failed = f"s{number}" == FAILED
            reason = "no point is inside" if failed else ""
            status = "failed" if failed else "ok"
            rows.append(Status(f"s{number}", "ball", status, "inner", reason, 1, 0.5, 1.5, ""))
            if not failed:
                write_skeleton_ply(path / f"s{number}.ply", Skeleton(skeleton_of(number), np.ones(4)))
        write_status(path, rows)
    return paths


def measure(clouds, folders):
    return measure_local_feature_sizes(clouds, folders, progress=False)


def test_distances_are_those_of_the_original_frame_over_the_scale(folders):
    priors = measure(CLOUDS, folders)
    assert priors.distances.dtype == np.float32
    assert priors.ids.tolist() == CLOUDS.ids.tolist()
    for number, shape in enumerate(CLOUDS.ids):
        if shape == FAILED:
            continue
        original = CLOUDS.points[number].astype(float) * CLOUDS.scales[number] + CLOUDS.centres[number]
        nearest = [min(math.dist(point, centre) for centre in skeleton_of(number)) for point in original]
        np.testing.assert_allclose(priors.distances[number], nearest / CLOUDS.scales[number], rtol=1e-4)


def test_a_failed_shape_has_no_distances_and_a_reason(folders):
    priors = measure(CLOUDS, folders)
    assert np.isnan(priors.distances[3]).all()
    assert priors.reasons.tolist() == ["", "", "", "inner: no point is inside", ""]
    assert np.isfinite(np.delete(priors.distances, 3, axis=0)).all()


def test_neither_the_order_of_the_shapes_nor_of_the_folders_matters(folders):
    priors, order = measure(CLOUDS, folders), [4, 0, 3]
    some = measure(select(CLOUDS, order), folders[::-1])
    assert np.array_equal(some.distances, priors.distances[order], equal_nan=True)
    assert some.reasons.tolist() == priors.reasons[order].tolist()


def test_a_shape_without_a_status_is_refused(folders):
    with pytest.raises(ShapeError, match="s1: is in none of the 1 skeleton folders"):
        measure(CLOUDS, folders[:1])


def test_failed_shapes_are_counted(caplog):
    priors = tiny_priors(CLOUDS, failed=(1, 2))
    check_priors(priors, 2)
    assert [record.getMessage() for record in caplog.records] == [
        "failed: s1: inner: no inside", "failed: s2: inner: no inside"
    ]  # fmt: skip
    with pytest.raises(ShapeError, match=r"2 shapes have no skeleton, 1 are tolerated .* the first: s1: inner"):
        check_priors(priors, 1)
    check_priors(tiny_priors(CLOUDS), 0)


def test_a_file_gives_the_distances_back(tmp_path):
    priors = tiny_priors(CLOUDS, failed=(1,))
    write_prior_set(priors, tmp_path / "priors.npz")
    again = read_prior_set(tmp_path / "priors.npz", CLOUDS)
    assert again.distances.dtype == np.float32
    assert np.array_equal(again.distances, priors.distances, equal_nan=True)
    assert again.ids.tolist() == priors.ids.tolist()
    assert again.reasons.tolist() == priors.reasons.tolist()


def test_a_file_of_other_clouds_is_refused(tmp_path):
    write_prior_set(tiny_priors(CLOUDS), tmp_path / "priors.npz")
    others = [select(CLOUDS, [1, 0, 2, 3, 4]), select(CLOUDS, [0, 1]), tiny_clouds(shapes=5, points=13)]
    for clouds in others:
        with pytest.raises(InputError, match=rf"priors\.npz: belongs to other clouds, 5 instead of {len(clouds)}"):
            read_prior_set(tmp_path / "priors.npz", clouds)


def test_other_files_are_refused(tmp_path):
    (tmp_path / "empty.npz").touch()
    np.save(tmp_path / "array.npy", np.zeros(3))
    np.savez(tmp_path / "others.npz", ids=CLOUDS.ids)
    for name in ("absent.npz", "empty.npz", "array.npy", "others.npz"):
        with pytest.raises(InputError, match=rf"{name}: expected a file of local feature sizes \("):
            read_prior_set(tmp_path / name, CLOUDS)
