import pytest
import torch
from torch.autograd import gradcheck

from benchmarks.naive_edge_convolution import NaiveEdgeConvolution
from morphoskel.errors import InputError
from morphoskel.networks.edge_convolution import EdgeConvolution, EdgeReduction, reduce_gathered_edges
from morphoskel.networks.feature_neighbours import nearest_in_features

PARAMETERS = ("linear.weight", "normalise.weight", "normalise.bias")


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def random_tensor(*sizes, seed=0, dtype=torch.float32):
    return torch.randn(*sizes, generator=torch.Generator().manual_seed(seed), dtype=dtype)


def layers(inputs, outputs, dtype=torch.float32):
    """Return the layer and its naive twin in the same state, half of whose scales are negative."""
    torch.manual_seed(0)
    naive, ours = NaiveEdgeConvolution(inputs, outputs).to(dtype), EdgeConvolution(inputs, outputs).to(dtype)
    with torch.no_grad():
        naive.normalise.weight.copy_(random_tensor(outputs, seed=1))
        naive.normalise.bias.copy_(random_tensor(outputs, seed=2))
        naive.normalise.running_mean.copy_(random_tensor(outputs, seed=3))
        naive.normalise.running_var.copy_(random_tensor(outputs, seed=4).abs() + 0.1)
    assert (naive.normalise.weight < 0).any()
    assert (naive.normalise.weight > 0).any()
    ours.load_state_dict(naive.state_dict())
    return ours, naive


def output_and_gradients(layer, features, neighbours):
    features = features.clone().requires_grad_()
    output = layer(features, neighbours)
    (output * random_tensor(*output.shape, seed=5).to(output.dtype)).sum().backward()
    return output.detach(), features.grad, *(layer.get_parameter(name).grad for name in PARAMETERS)


@pytest.mark.parametrize("training", [True, False])
@pytest.mark.parametrize(("dtype", "tolerance"), [(torch.float32, 2e-4), (torch.float64, 1e-10)])
@pytest.mark.parametrize(
    ("batch", "points", "inputs", "outputs", "k"), [(2, 40, 3, 8, 5), (1, 300, 16, 70, 20), (3, 6, 4, 5, 1)]
)
def test_outputs_gradients_and_statistics_equal_those_of_the_naive_layer(
    batch, points, inputs, outputs, k, dtype, tolerance, training
):
    ours, naive = layers(inputs, outputs, dtype)
    ours.train(training)
    naive.train(training)
    features = random_tensor(batch, points, inputs, dtype=dtype)
    neighbours = nearest_in_features(features, k)
    for _ in range(2):
        for layer in (ours, naive):
            layer.zero_grad()
        expected = output_and_gradients(naive, features, neighbours)
        for found, wanted in zip(output_and_gradients(ours, features, neighbours), expected, strict=True):
            torch.testing.assert_close(found, wanted, rtol=tolerance, atol=tolerance * float(wanted.abs().max()))
    state = naive.state_dict()
    for name, value in ours.state_dict().items():
        torch.testing.assert_close(value, state[name], rtol=1e-5, atol=1e-6)
    assert int(ours.normalise.num_batches_tracked) == (2 if training else 0)


def test_points_that_are_missing_from_all_neighbourhoods_get_gradients():
    ours, naive = layers(3, 8, torch.float64)
    features = random_tensor(2, 12, 3, dtype=torch.float64)
    neighbours = torch.randint(0, 4, (2, 12, 5), generator=torch.Generator().manual_seed(0))
    expected = output_and_gradients(naive, features, neighbours)
    for found, wanted in zip(output_and_gradients(ours, features, neighbours), expected, strict=True):
        torch.testing.assert_close(found, wanted)


@pytest.mark.parametrize("reduce", [EdgeReduction.apply, reduce_gathered_edges])
@pytest.mark.parametrize("with_moments", [True, False])
def test_gradients_of_the_reduction_equal_finite_differences(reduce, with_moments):
    values = random_tensor(2, 7, 6, dtype=torch.float64).requires_grad_()
    neighbours = torch.randint(0, 7, (2, 7, 4), generator=torch.Generator().manual_seed(0))

    def outputs(values):
        return tuple(output for output in reduce(values, neighbours, with_moments) if output.numel())

    assert len(outputs(values)) == (3 if with_moments else 1)
    assert gradcheck(outputs, values)


def test_the_kernels_and_the_tensor_library_reduce_alike():
    neighbours = torch.randint(0, 300, (2, 300, 9), generator=torch.Generator().manual_seed(0))
    results = []
    for reduce in (EdgeReduction.apply, reduce_gathered_edges):
        values = random_tensor(2, 300, 140).requires_grad_()
        outputs = reduce(values, neighbours, True)
        sum((output * random_tensor(*output.shape, seed=6)).sum() for output in outputs).backward()
        results.append((*outputs, values.grad))
    for found, wanted in zip(*results, strict=True):
        torch.testing.assert_close(found, wanted, rtol=1e-4, atol=1e-5)


def test_of_equal_edges_the_first_gets_the_gradient():
    values = torch.zeros(1, 4, 2).requires_grad_()
    EdgeReduction.apply(values, torch.tensor([[[2, 1], [1, 2], [3, 2], [3, 0]]]), False)[0].sum().backward()
    assert values.grad[0].tolist() == [[0, 1], [1, 1], [1, 1], [2, 1]]


def test_the_variance_is_exact_far_from_zero():
    """A difference of mean squares in single precision would be off by its whole size."""
    values = random_tensor(2, 200, 8) + 1000
    neighbours = torch.randint(0, 200, (2, 200, 6), generator=torch.Generator().manual_seed(0))
    _, mean, variance = EdgeReduction.apply(values, neighbours, True)
    _, exact_mean, exact_variance = reduce_gathered_edges(values.double(), neighbours, True)
    torch.testing.assert_close(mean.double(), exact_mean, rtol=1e-6, atol=0)
    torch.testing.assert_close(variance.double(), exact_variance, rtol=1e-4, atol=0)


@pytest.mark.parametrize("threads", [1, 2])
def test_results_are_the_same_to_the_last_bit(threads):
    """Sums of an edge's values may not depend on which thread comes first, nor on how many there are."""
    values = random_tensor(3, 300, 260)
    neighbours = torch.randint(0, 300, (3, 300, 9), generator=torch.Generator().manual_seed(0))

    def results():
        leaf = values.clone().requires_grad_()
        outputs = EdgeReduction.apply(leaf, neighbours, True)
        sum(output.square().sum() for output in outputs).backward()
        return (*outputs, leaf.grad)

    first = results()
    torch.set_num_threads(threads)
    second = results()
    torch.set_num_threads(1)
    assert all(torch.equal(a, b) for a, b in zip(first, second, strict=True))


def test_a_scale_of_zero_has_a_gradient():
    ours, naive = layers(3, 6, torch.float64)
    for layer in (ours, naive):
        torch.nn.init.zeros_(layer.normalise.weight)
    features = random_tensor(2, 20, 3, dtype=torch.float64)
    neighbours = nearest_in_features(features, 1)  # with one edge a point, which of them is the largest is not open
    found, wanted = (output_and_gradients(layer, features, neighbours) for layer in (ours, naive))
    torch.testing.assert_close(found[3], wanted[3])
    assert found[3].abs().min() > 0


def test_autocast_does_not_lower_the_precision():
    ours, _ = layers(3, 8)
    features = random_tensor(2, 20, 3)
    neighbours = nearest_in_features(features, 4)
    expected = ours.eval()(features, neighbours)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        found = ours(features, neighbours)
    assert found.dtype == torch.float32
    assert torch.equal(found, expected)


@pytest.mark.parametrize("index", [-1, 10])
def test_neighbours_that_do_not_exist_are_refused(index):
    """Compiled code would read memory that is not the array's."""
    neighbours = torch.zeros(1, 10, 3, dtype=torch.int64)
    neighbours[0, 4, 1] = index
    with pytest.raises(InputError, match="neighbours: expected 0 to 9"):
        EdgeConvolution(3, 4)(random_tensor(1, 10, 3), neighbours)


def test_a_single_edge_has_no_variance():
    layer = EdgeConvolution(3, 4)
    with pytest.raises(InputError, match="at least 2 edges"):
        layer(random_tensor(1, 1, 3), torch.zeros(1, 1, 1, dtype=torch.int64))
    assert layer.eval()(random_tensor(1, 1, 3), torch.zeros(1, 1, 1, dtype=torch.int64)).shape == (1, 1, 4)
