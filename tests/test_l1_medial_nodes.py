import numpy as np

from morphoskel.skeleton.l1_medial import L1MedialSettings
from morphoskel.skeleton.l1_medial.branches import Branch
from morphoskel.skeleton.l1_medial.nodes import assemble
from morphoskel.skeleton.l1_medial.samples import FIXED, REMOVED, Samples


def star():
    """Three arms of length 0.3 that share sample 0, a bridge at the end of one of them, and two samples aside."""
    arms = np.concatenate([np.outer(np.arange(1, 4) * 0.1, ray) for ray in np.eye(3)])
    samples = Samples(np.vstack([np.zeros((1, 3)), arms, [[9.0, 9, 9], [8, 8, 8]]]))
    samples.states[:9], samples.states[10] = FIXED, REMOVED
    return [Branch([0, 1, 2, 3]), Branch([0, 4, 5, 6]), Branch([0, 7, 8, 9], open_end=True)], samples


def test_curves_share_their_junction_and_leftover_samples_come_last():
    branches, samples = star()
    cloud = np.random.default_rng(0).random((50, 3))
    nodes, edges = assemble(branches, samples, cloud, L1MedialSettings(spacing=0.05, recentre=False))
    assert len(nodes) == 1 + 3 * 6 + 1
    assert np.array_equal(nodes[-1], [8, 8, 8])
    counts = np.bincount(edges.ravel(), minlength=len(nodes))
    assert np.bincount(counts).tolist() == [1, 3, 15, 1]
    assert np.array_equal(nodes[counts == 3], np.zeros((1, 3)))
    np.testing.assert_allclose(np.linalg.norm(nodes[edges[:, 0]] - nodes[edges[:, 1]], axis=1), 0.05)


def test_leftover_samples_can_be_left_out():
    branches, samples = star()
    cloud = np.random.default_rng(0).random((50, 3))
    nodes, _ = assemble(branches, samples, cloud, L1MedialSettings(spacing=0.05, keep_leftover=False))
    assert len(nodes) == 19
    nodes, edges = assemble([], samples, cloud, L1MedialSettings())
    assert np.array_equal(nodes, samples.points[[9, 11]])
    assert edges.shape == (0, 2)
