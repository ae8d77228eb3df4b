from dataclasses import replace

import pytest
import torch
from tiny_generator import TINY

from morphoskel.errors import InputError
from morphoskel.learning.generator_phases import GeneratorPhase
from morphoskel.learning.resumable_fit import resumable_fit
from morphoskel.learning.simplification_loss import simplification_loss
from morphoskel.learning.task_loss import task_loss
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.networks.point_generator import PointGenerator, generate
from morphoskel.networks.pointnet_classifier import PointNetClassifier
from morphoskel.sampling.matching import match_and_complete

CLASSIFIER = ClassifierSettings(
    dropped_points=0.875,
    drop_style="overwrite",
    lowest_scale=0.8,
    highest_scale=1.25,
    shift=0.1,
    feature_dropout=0.4,
    penalty=0.001,
    batch_size=4,
    epochs=1,
    learning_rate=1e-3,
    weight_decay=1e-4,
    decay=0.7,
    decay_epochs=20,
)

METHODS = {
    "snet": replace(TINY, neighbours=0, augmentation="rotation"),
    "samplenet": TINY,
    "metasampler": replace(TINY, normalise_output=False, alpha=1.0, augmentation="dropout", neighbours=5),
}


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="module")
def classifiers():
    """Make two classifiers that nobody trained; their gradients are as good as any."""
    torch.manual_seed(3)
    return PointNetClassifier(2, CLASSIFIER), PointNetClassifier(2, CLASSIFIER)


@pytest.fixture(scope="module")
def clouds():
    """Make eight balls and sticks: points and labels."""
    points = torch.randn(8, 32, 3, generator=torch.Generator().manual_seed(0))
    points = torch.nn.functional.normalize(points, dim=-1)
    points[::2, :, :2] *= 0.1
    return points, torch.arange(8) % 2


class KilledError(Exception):
    pass


class KilledPhase(GeneratorPhase):
    """Stop at a certain step of the training."""

    killed_at = None
    steps = 0

    def loss(self, batch):
        self.steps += self.training
        if self.steps == self.killed_at:
            raise KilledError
        return super().loss(batch)


def phase_of(clouds, classifiers, settings=TINY, kind=GeneratorPhase):
    torch.manual_seed(0)
    network = PointGenerator(6, settings)
    validation = (clouds[0][:3], clouds[1][:3])
    return kind("sampler", network, classifiers, clouds, validation, settings, 0)


def fit(phase, folder):
    resumable_fit(phase, phase.settings.epochs, folder, accelerator="cpu", progress=False)
    return phase


@pytest.mark.parametrize("method", METHODS)
def test_a_few_steps_lower_the_loss(clouds, classifiers, method):
    phase = phase_of(clouds, classifiers, METHODS[method]).train()
    optimiser = phase.configure_optimizers()["optimizer"]
    losses = []
    for _ in range(25):
        torch.manual_seed(0)
        loss = phase.loss(clouds)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        losses.append(float(loss.detach()))
    assert losses[-1] < 0.8 * losses[0]


def test_the_loss_is_the_published_sum(clouds, classifiers):
    """In evaluation mode, so that the generated points are the same in both computations."""
    settings = replace(TINY, task_weight=2.0, projection_weight=5.0, delta=0.5, least_sigma=0.1)
    phase = phase_of(clouds, classifiers, settings).eval()
    points, labels = clouds
    torch.nn.init.constant_(phase.network.projection.temperature, 0.2)
    generated = phase.network(points)
    projected = phase.network.projection(points, generated)
    task = sum(task_loss(classifier, projected, labels, 0.001) for classifier in classifiers) / 2
    expected = 2 * task + 30 * simplification_loss(points, generated, gamma=1.0, delta=0.5) + 5 * 0.1
    torch.testing.assert_close(phase.loss(clouds), expected)


def test_without_projection_the_task_sees_the_generated_points(clouds, classifiers):
    phase = phase_of(clouds, classifiers[:1], replace(TINY, neighbours=0)).eval()
    points, labels = clouds
    generated = phase.network(points)
    simplification = simplification_loss(points, generated, gamma=1.0, delta=0.0)
    torch.testing.assert_close(
        phase.loss(clouds), task_loss(classifiers[0], generated, labels, 0.001) + 30 * simplification
    )


def test_validation_judges_the_points_that_inference_returns(clouds, classifiers):
    phase = phase_of(clouds, classifiers).eval()
    points, labels = clouds
    total = 0.0
    with torch.no_grad():
        generated = phase.network(points)
        for classifier in classifiers:
            for cloud, label, found in zip(points, labels, generated, strict=True):
                chosen = cloud[match_and_complete(cloud.numpy(), found.numpy()).indices]
                total -= float(classifier.eval()(chosen[None]).log_probabilities[0, label])
        assert float(phase.validation_loss(clouds)) == pytest.approx(total / 16, rel=1e-4)


@pytest.mark.parametrize(("augmentation", "varied"), [("none", False), ("rotation", True), ("dropout", True)])
def test_training_clouds_are_varied_as_the_settings_say(clouds, classifiers, augmentation, varied):
    phase = phase_of(clouds, classifiers, replace(TINY, augmentation=augmentation)).eval()
    seen = []
    phase.network.register_forward_pre_hook(lambda _, arguments: seen.append(arguments[0]))
    for seed in (0, 0, 1):
        torch.manual_seed(seed)
        phase.loss(clouds)
    assert torch.equal(seen[0], seen[1])
    assert torch.equal(seen[0], seen[2]) != varied
    assert torch.equal(seen[0], clouds[0]) != varied
    moved = (seen[0] - clouds[0]).abs()
    if augmentation == "rotation":
        assert float(moved[..., 1].max()) <= 0.05 + 1e-6  # along the axis there is jitter only
        assert float(moved[..., 0].max()) > 0.5
    if augmentation == "dropout":
        assert min(len(cloud.unique(dim=0)) for cloud in seen[0]) < 32
        assert float(moved[:, 0].max()) > 0.05  # the first point is never dropped, but scaled and shifted


def test_the_learning_rate_falls_in_stairs_to_its_floor(clouds, classifiers):
    settings = replace(TINY, decay=0.5, decay_share=0.25, least_learning_rate=0.002)
    phase = phase_of(clouds, classifiers, settings)
    phase.total_steps = 10
    configured = phase.configure_optimizers()
    assert configured["lr_scheduler"]["interval"] == "step"
    optimiser, schedule = configured["optimizer"], configured["lr_scheduler"]["scheduler"]
    rates = []
    for _ in range(10):
        rates.append(optimiser.param_groups[0]["lr"])
        optimiser.step()
        schedule.step()
    # A decay every two and a half steps: 0, 1, 2 | 3, 4 | 5, 6, 7 | 8, 9
    assert rates == pytest.approx([0.01] * 3 + [0.005] * 2 + [0.0025] * 3 + [0.002] * 2)


def test_the_momentum_of_the_statistics_falls_likewise(clouds, classifiers, tmp_path):
    settings = replace(TINY, decay_share=1 / 3, least_momentum=0.2, epochs=3)
    phase = phase_of(clouds, classifiers, settings)
    seen = []
    phase.network.register_forward_pre_hook(
        lambda network, _: (
            seen.append({module.momentum for module in network.modules() if hasattr(module, "momentum")})
            if network.training
            else None
        )
    )
    fit(phase, tmp_path)
    assert seen == [{0.5}, {0.5}, {0.25}, {0.25}, {0.2}, {0.2}]


def test_the_classifiers_stay_as_they_are(clouds, classifiers, tmp_path):
    before = [{name: value.clone() for name, value in each.state_dict().items()} for each in classifiers]
    phase = fit(phase_of(clouds, classifiers), tmp_path)
    assert {name.partition(".")[0] for name in phase.state_dict()} == {"network"}
    assert len(list(phase.parameters())) == len(list(phase.network.parameters()))
    for each, kept in zip(classifiers, before, strict=True):
        assert not each.training
        assert all(torch.equal(value, kept[name]) for name, value in each.state_dict().items())
        assert all(parameter.grad is None for parameter in each.parameters())


@pytest.mark.parametrize("killed_at", [2, 3, 6])
def test_a_killed_training_goes_on_to_the_same_weights(clouds, classifiers, tmp_path, killed_at):
    """With noise, a falling learning rate and a changing momentum: all must be taken up where they were."""
    settings = replace(METHODS["snet"], decay_share=1 / 3, neighbours=3)
    whole = fit(phase_of(clouds, classifiers, settings, KilledPhase), tmp_path / "whole")
    killed = phase_of(clouds, classifiers, settings, KilledPhase)
    killed.killed_at = killed_at
    with pytest.raises(KilledError):
        fit(killed, tmp_path / "killed")
    resumed = fit(phase_of(clouds, classifiers, settings, KilledPhase), tmp_path / "killed")
    assert (resumed.steps == 6) == (killed_at <= 2)  # only from the first epoch on is everything repeated
    for name, value in whole.state_dict().items():
        assert torch.equal(value, resumed.state_dict()[name]), name
    assert torch.equal(generate(whole.network, clouds[0], 4), generate(resumed.network, clouds[0], 4))


def test_nothing_to_learn_from_is_refused(clouds, classifiers):
    with pytest.raises(InputError, match="at least one trained classifier"):
        phase_of(clouds, ())
    with pytest.raises(InputError, match="at least two clouds"):
        phase_of((clouds[0][:1], clouds[1][:1]), classifiers)
