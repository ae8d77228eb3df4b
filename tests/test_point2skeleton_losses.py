import itertools

import numpy as np
import pytest
import torch

from morphoskel.evaluation.sphere_metrics import cd_recon, sphere_distances
from morphoskel.learning.point2skeleton_losses import (
    link_loss,
    point_to_sphere_loss,
    sampling_loss,
    skeleton_loss,
    summed_chamfer_loss,
)
from morphoskel.networks.skeletal_links import InitialGraph


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture
def shapes():
    torch.manual_seed(0)
    return torch.rand(3, 30, 3), torch.rand(3, 7, 3), torch.rand(3, 7) * 0.3


def chamfer_sums(a, b):
    distances = np.linalg.norm(a[:, None] - b[None], axis=2)
    return distances.min(axis=1).sum(), distances.min(axis=0).sum()


def test_the_summed_chamfer_distance(shapes):
    points, centres, _ = shapes
    sums = [sum(chamfer_sums(p.numpy(), c.numpy())) for p, c in zip(points, centres, strict=True)]
    assert float(summed_chamfer_loss(points, centres)) == pytest.approx(np.mean(sums), rel=1e-5)


def test_the_sampling_loss(shapes):
    points, centres, radii = shapes
    values = []
    for p, c, r in zip(points.numpy(), centres.numpy(), radii.numpy(), strict=True):
        corners = np.array(list(itertools.product([-1, 1], repeat=3))) / np.sqrt(3)
        samples = np.concatenate([centre + radius * corners for centre, radius in zip(c, r, strict=True)])
        of_points, of_samples = chamfer_sums(p, samples)
        values.append(of_points / len(p) + of_samples / len(samples))
    assert float(sampling_loss(points, centres, radii)) == pytest.approx(np.mean(values), rel=1e-5)


def test_the_point_to_sphere_loss_is_the_chamfer_distance_of_the_evaluation(shapes):
    values = [
        cd_recon(sphere_distances(p.double().numpy(), c.double().numpy(), r.double().numpy()), "correct")
        for p, c, r in zip(*shapes, strict=True)
    ]
    assert float(point_to_sphere_loss(*shapes)) == pytest.approx(np.mean(values), rel=1e-5)


def test_a_sphere_on_its_points_costs_nothing_but_its_radius():
    points = torch.nn.functional.normalize(torch.randn(1, 500, 3), dim=-1)
    centre, radius = torch.zeros(1, 1, 3), torch.ones(1, 1)
    assert float(point_to_sphere_loss(points, centre, radius)) == pytest.approx(0, abs=1e-6)
    assert float(point_to_sphere_loss(points, centre, radius / 2)) == pytest.approx(1)
    weights = {"point_to_sphere_weight": 0.3, "radius_weight": 0.4}
    expected = float(sampling_loss(points, centre, radius)) - 0.4
    assert float(skeleton_loss(points, centre, radius, **weights)) == pytest.approx(expected, abs=1e-6)


def test_a_loss_does_not_depend_on_the_batch_size(shapes):
    """The released program sums over the batch, so that its weights mean another thing for each batch size."""
    twice = [torch.cat([part, part]) for part in shapes]
    weights = {"point_to_sphere_weight": 0.3, "radius_weight": 0.4}
    torch.testing.assert_close(skeleton_loss(*twice, **weights), skeleton_loss(*shapes, **weights))
    torch.testing.assert_close(summed_chamfer_loss(*twice[:2]), summed_chamfer_loss(*shapes[:2]))


def test_gradients_are_finite_where_distances_are_zero():
    points = torch.rand(2, 20, 3)
    centres, radii = points[:, :5].clone().requires_grad_(), torch.zeros(2, 5, requires_grad=True)
    loss = skeleton_loss(points, centres, radii, point_to_sphere_weight=0.3, radius_weight=0.4)
    (loss + summed_chamfer_loss(points, centres)).backward()
    assert centres.grad.isfinite().all()
    assert radii.grad.isfinite().all()


def random_graph(batch, count):
    links = torch.rand(batch, count, count) < 0.2
    links[:, 0, 1] = True
    far = torch.rand(batch, count, count) < 0.5
    links, far = ((part | part.transpose(1, 2)) & ~torch.eye(count, dtype=torch.bool) for part in (links, far))
    return InitialGraph(links, links | ~far, links | far)


def test_the_link_loss():
    torch.manual_seed(0)
    graph, scores = random_graph(3, 9), torch.randn(3, 9, 9)
    values = []
    for b in range(3):
        links, known = graph.links[b].numpy(), graph.known[b].numpy()
        ratio = (known.sum() - links.sum()) / links.sum()
        probability = 1 / (1 + np.exp(-scores[b].numpy()))
        terms = np.where(links, -ratio * np.log(probability), -np.log(1 - probability))
        values.append((terms * known).sum() / 81)
    assert float(link_loss(scores, graph)) == pytest.approx(np.mean(values), rel=1e-5)


def test_unknown_pairs_do_not_count():
    torch.manual_seed(0)
    graph, scores = random_graph(2, 9), torch.randn(2, 9, 9)
    changed = torch.where(graph.known, scores, 100.0)
    assert not torch.equal(changed, scores)
    torch.testing.assert_close(link_loss(changed, graph), link_loss(scores, graph))
