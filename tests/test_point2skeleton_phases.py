from dataclasses import replace

import numpy as np
import pytest
import torch
from tiny_point2skeleton import TINY

from morphoskel.learning.point2skeleton_phases import LinkPhase, SkeletalPointPhase, skeletal_graphs
from morphoskel.networks.cloud_preparation import prepare_cloud
from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork
from morphoskel.networks.skeletal_links import initial_graph, node_inputs


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture
def clouds():
    generator = np.random.default_rng(0)
    shapes = [generator.normal(size=(80, 3)) * (1, 0.4, 0.1) for _ in range(3)]
    return torch.stack([prepare_cloud(shape, TINY.points).points for shape in shapes])


def losses(phase, batch, steps=50):
    optimizer, history = phase.configure_optimizers(), []
    for _ in range(steps):
        optimizer.zero_grad()
        loss = phase.loss(batch)
        loss.backward()
        optimizer.step()
        history.append(float(loss.detach()))
    return history


@pytest.mark.parametrize("name", ["pretrain", "skeleton"])
def test_the_loss_decreases_on_one_shape(clouds, name):
    """Fifty steps on a single shape, without dropout, whose noise would hide it."""
    torch.manual_seed(0)
    settings = replace(TINY, dropout=0.0, learning_rate=5e-3)
    phase = SkeletalPointPhase(name, Point2SkeletonNetwork(settings), clouds[:1], clouds[:1], seed=0)
    history = losses(phase, (clouds[:1],))
    assert max(history[-5:]) < 0.8 * history[0]


def test_the_loss_of_the_links_decreases_while_the_skeletal_points_stay(clouds):
    torch.manual_seed(0)
    network = Point2SkeletonNetwork(replace(TINY, link_learning_rate=5e-3))
    before = {name: value.clone() for name, value in network.skeletal_points.state_dict().items()}
    phase = LinkPhase(network, clouds, clouds[:1], seed=0)
    phase.on_fit_start()
    history = losses(phase, phase.training_tensors)
    assert max(history[-5:]) < 0.8 * history[0]
    assert all(torch.equal(value, before[name]) for name, value in network.skeletal_points.state_dict().items())


def test_graphs_are_those_of_each_cloud_alone(clouds):
    torch.manual_seed(0)
    network = Point2SkeletonNetwork(TINY).train()
    graphs = skeletal_graphs(network, clouds, torch.device("cpu"))
    assert network.training
    network.eval()
    for i in range(3):
        with torch.no_grad():
            skeletal = network.skeletal_points(clouds[i : i + 1])
        alone = (node_inputs(skeletal), *initial_graph(clouds[i : i + 1], skeletal.centres, TINY.valid_neighbours))
        torch.testing.assert_close(graphs[0][i], alone[0][0], rtol=1e-4, atol=1e-6)
        for together, own in zip(graphs[1:], alone[1:], strict=True):
            assert torch.equal(together[i], own[0])
