import pytest
import torch
from tiny_skeleton_aware import TINY_SKELETON

from morphoskel.learning.point2skeleton_losses import point_to_sphere_loss, sampling_loss
from morphoskel.learning.skeleton_aware_phases import PRETRAIN, SKELETON, SkeletonAwarePhase
from morphoskel.networks.skeleton_aware_network import SkeletonAwareNetwork, cloud_neighbourhoods


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def shapes():
    points = torch.rand(2, 40, 3, generator=torch.Generator().manual_seed(0)) - 0.5
    return points, cloud_neighbourhoods(points, TINY_SKELETON)


def build(name, shapes):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return SkeletonAwarePhase(name, SkeletonAwareNetwork(TINY_SKELETON), shapes, shapes, 0)


def test_the_first_phase_spreads_the_centres(shapes):
    """The unsquared Chamfer distance of each cloud, summed over points, averaged over clouds, times 1e-4."""
    phase = build(PRETRAIN, shapes)
    centres = phase.network(*shapes).centres
    gaps = (shapes[0][:, :, None] - centres[:, None]).norm(dim=-1)
    naive = 1e-4 * (gaps.amin(dim=2).sum(dim=1) + gaps.amin(dim=1).sum(dim=1)).mean()
    torch.testing.assert_close(phase.loss(shapes), naive)


def test_the_second_phase_fits_balls(shapes):
    phase = build(SKELETON, shapes)
    centres, radii, _ = phase.network(*shapes)
    sampled, touched = sampling_loss(shapes[0], centres, radii), point_to_sphere_loss(shapes[0], centres, radii)
    torch.testing.assert_close(phase.loss(shapes), sampled + 0.3 * touched - 0.4 * radii.mean())


@pytest.mark.parametrize("name", [PRETRAIN, SKELETON])
def test_the_loss_decreases(name, shapes):
    phase = build(name, shapes)
    optimiser = phase.configure_optimizers()
    losses = []
    for _ in range(40):
        optimiser.zero_grad()
        loss = phase.loss(shapes)
        loss.backward()
        optimiser.step()
        losses.append(float(loss.detach()))
    assert losses[-1] < 0.6 * losses[0]
    assert max(losses[-10:]) < min(losses[:5])
