import pytest
import torch

from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.networks.skeletal_links import (
    GraphConvolution,
    LinkNetwork,
    initial_graph,
    node_inputs,
    predicted_links,
    propagation_matrix,
)
from morphoskel.networks.skeletal_points import SkeletalPoints


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def initial_graph_naive(points, centres, valid_neighbours):
    count = len(centres)
    between = torch.cdist(centres, centres)
    order = [sorted(range(count), key=lambda j, i=i: (j != i, float(between[i, j]))) for i in range(count)]
    links, near, far = (torch.zeros(count, count, dtype=torch.bool) for _ in range(3))
    for point in points:
        a, b = (centres - point).norm(dim=1).argsort()[:2]
        links[a, b] = links[b, a] = True
    for i, row in enumerate(order):
        links[i, row[1]] = links[row[1], i] = True
        for j in row[1:valid_neighbours]:
            near[i, j] = near[j, i] = True
        for j in row[valid_neighbours:]:
            far[i, j] = far[j, i] = True
    return links, links | near, links | far


def test_the_initial_graph_equals_the_definition():
    torch.manual_seed(0)
    points, centres = torch.rand(3, 60, 3), torch.rand(3, 15, 3)
    graph = initial_graph(points, centres, 5)
    for b in range(3):
        for fast, plain in zip(graph, initial_graph_naive(points[b], centres[b], 5), strict=True):
            assert torch.equal(fast[b], plain)


def test_points_on_a_line_are_linked_in_a_row_and_only_near_pairs_are_open():
    centres = torch.zeros(1, 10, 3)
    centres[0, :, 0] = torch.arange(10.0)
    points = torch.stack([torch.linspace(0, 9, 100), *torch.zeros(2, 100)], dim=1)[None]
    graph = initial_graph(points, centres, 4)
    row = torch.diag(torch.ones(9), 1) + torch.diag(torch.ones(9), -1)
    assert torch.equal(graph.links[0], row.bool())
    assert graph.known[0, 0, 9]
    assert not graph.valid[0, 0, 9]
    assert graph.valid[0, 3, 5] | graph.valid[0, 3, 1]


def test_coinciding_skeletal_points_are_not_linked_to_themselves():
    graph = initial_graph(torch.rand(1, 30, 3), torch.zeros(1, 6, 3), 3)
    for pairs in graph:
        assert not pairs.diagonal(dim1=1, dim2=2).any()
        assert torch.equal(pairs, pairs.transpose(1, 2))


def test_the_propagation_of_a_regular_graph_takes_means():
    """Of a ring, where each node has two neighbours, the propagated constant is the constant."""
    ring = torch.roll(torch.eye(6), 1, dims=1)
    propagation = propagation_matrix((ring + ring.T).bool()[None])
    torch.testing.assert_close(propagation.sum(dim=-1), torch.ones(1, 6))
    torch.testing.assert_close(propagation_matrix(torch.zeros(1, 4, 4, dtype=torch.bool))[0], torch.eye(4))


@pytest.fixture(scope="module")
def network():
    torch.manual_seed(0)
    return LinkNetwork(6, Point2SkeletonSettings(node_features=4, graph_channels=(8, 8, 12, 12, 10))).eval()


def test_shortcuts_where_the_released_program_has_them(network):
    kinds = [type(convolution.shortcut).__name__ for convolution in network.convolutions]
    assert kinds == ["NoneType", "NoneType", "Sequential", "Identity"]


def test_scores_are_symmetric_and_follow_the_order_of_the_nodes(network):
    torch.manual_seed(1)
    nodes = torch.rand(2, 20, 10)
    links = torch.rand(2, 20, 20) < 0.2
    links = (links | links.transpose(1, 2)) & ~torch.eye(20, dtype=torch.bool)
    scores = network(nodes, links)
    torch.testing.assert_close(scores, scores.transpose(1, 2))
    order = torch.randperm(20)
    permuted = network(nodes[:, order], links[:, order][:, :, order])
    torch.testing.assert_close(permuted, scores[:, order][:, :, order], rtol=1e-3, atol=1e-3)


def test_one_graph_is_normalised_by_its_own_statistics():
    """A skeleton is used alone; running statistics would make it depend on the batches of the training."""
    torch.manual_seed(0)
    convolution = GraphConvolution(3, 5, residual=False).eval()
    nodes = torch.rand(1, 30, 3)
    propagation = propagation_matrix(torch.zeros(1, 30, 30, dtype=torch.bool))
    scaled = convolution(nodes * 100 + 7, propagation)
    torch.testing.assert_close(scaled, convolution(nodes, propagation), rtol=1e-2, atol=1e-2)


def test_only_valid_pairs_above_the_threshold_are_links():
    scores = torch.tensor([[[0.0, 0.9, 0.8], [0.9, 0.0, 2.0], [0.8, 2.0, 0.0]]])
    valid = torch.tensor([[[False, True, True], [True, False, False], [True, False, False]]])
    assert predicted_links(scores, valid, 0.8).nonzero().tolist() == [[0, 0, 1], [0, 1, 0]]


def test_node_inputs_have_no_gradient():
    values = [torch.rand(1, 4, *size, requires_grad=True) for size in ((3,), (), (6,), (9,))]
    nodes = node_inputs(SkeletalPoints(*values, torch.rand(1, 9, 3)))
    assert nodes.shape == (1, 4, 10)
    assert not nodes.requires_grad
    torch.testing.assert_close(nodes[..., -4:-1], values[0].detach())
