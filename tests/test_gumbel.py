import math

import pytest
import torch

from morphoskel.networks.skeleton_sampler_settings import TemperatureSettings
from morphoskel.sampling.gumbel import best_indices, draw_indices, gumbel_noise, gumbel_softmax, temperature

PUBLISHED = TemperatureSettings(start=1.0, end=0.5, annealed_share=0.8, every=100)


def seeded(seed=0):
    return torch.Generator().manual_seed(seed)


def test_the_noise_is_gumbel_distributed():
    """Its quantiles are those of the distribution function exp(-exp(-x)); its mean is Euler's constant."""
    noise = gumbel_noise((200_000,), seeded())
    assert noise.isfinite().all()
    for share in (0.05, 0.25, 0.5, 0.75, 0.95):
        below = (noise <= -math.log(-math.log(share))).double().mean()
        assert float(below) == pytest.approx(share, abs=0.005)
    assert float(noise.mean()) == pytest.approx(0.5772, abs=0.01)


def test_noise_comes_from_the_generator_it_is_given():
    assert torch.equal(gumbel_noise((4, 5), seeded(1)), gumbel_noise((4, 5), seeded(1)))
    assert not torch.equal(gumbel_noise((4, 5), seeded(1)), gumbel_noise((4, 5), seeded(2)))
    with torch.random.fork_rng():
        torch.manual_seed(1)
        assert torch.equal(gumbel_noise((4, 5), None), gumbel_noise((4, 5), seeded(1)))


def test_soft_rows_become_one_hot_as_the_temperature_falls():
    logits = torch.randn(2, 8, 30, generator=seeded())
    noise = gumbel_noise(logits.shape, seeded(1))
    hard = torch.nn.functional.one_hot(draw_indices(logits, seeded(1)), 30).float()
    assert torch.equal(hard.sum(dim=-1), torch.ones(2, 8))
    for value in (1.0, 0.5, 1e-4):
        soft = gumbel_softmax(logits, value, noise)
        torch.testing.assert_close(soft.sum(dim=-1), torch.ones(2, 8))
        assert torch.equal(soft.argmax(dim=-1), hard.argmax(dim=-1))
    assert float((soft - hard).abs().max()) < 0.01
    torch.testing.assert_close(gumbel_softmax(logits, 1.0, torch.zeros_like(logits)), logits.softmax(dim=-1))


def test_points_are_drawn_with_the_probabilities_of_the_logits():
    probabilities = torch.tensor([0.1, 0.2, 0.7])
    drawn = draw_indices(probabilities.log().expand(1, 40_000, 3), seeded()).flatten()
    torch.testing.assert_close(drawn.bincount(minlength=3) / 40_000, probabilities, atol=0.01, rtol=0)


def test_equal_logits_draw_as_many_distinct_points_as_chance_does():
    """128 independent uniform draws of 1024 points hit 1024 (1 - (1 - 1/1024)^128) = 120.4 of them."""
    expected = 1024 * (1 - (1 - 1 / 1024) ** 128)
    assert expected == pytest.approx(120.4, abs=0.05)
    drawn = draw_indices(torch.zeros(1, 1, 1).expand(100, 128, 1024), seeded())
    distinct = [len(row.unique()) for row in drawn]
    assert sum(distinct) / len(distinct) == pytest.approx(expected, abs=1)
    assert drawn.dtype == torch.int64


def test_without_noise_the_largest_logit_wins():
    logits = torch.randn(3, 5, 7, generator=seeded())
    for cloud, row in zip(logits, best_indices(logits), strict=True):
        assert [int(values.argmax()) for values in cloud] == row.tolist()
    certain = torch.nn.functional.one_hot(best_indices(logits), 7) * 1e3
    assert torch.equal(draw_indices(certain, seeded()), best_indices(logits))


def test_a_constant_of_each_sample_changes_nothing():
    """So a bias of the sampler's last layer, which is such a constant, has no effect."""
    logits, bias = torch.randn(2, 5, 9, generator=seeded(), dtype=torch.float64), torch.tensor([3.0, -1, 0.5, 8, 2])
    noise = gumbel_noise(logits.shape, seeded(1))
    biased = logits + bias[:, None]
    torch.testing.assert_close(gumbel_softmax(biased, 0.7, noise), gumbel_softmax(logits, 0.7, noise))
    assert torch.equal(draw_indices(biased, seeded(1)), draw_indices(logits, seeded(1)))
    assert torch.equal(best_indices(biased), best_indices(logits))


def test_the_temperature_falls_from_1_to_a_half_in_four_fifths_of_the_steps():
    total = 10_000
    values = [temperature(step, total, PUBLISHED) for step in range(total)]
    assert values[0] == 1
    assert values[4000] == pytest.approx(0.5**0.5)
    assert values[7999] > 0.5
    assert set(values[8000:]) == {0.5}
    for start in range(0, total, 100):
        assert len(set(values[start : start + 100])) == 1
    assert len(set(values)) == 81
    ratios = {round(b / a, 12) for a, b in zip(values[:8000:100], values[100:8001:100], strict=True)}
    assert len(ratios) == 1  # exponential


def test_a_training_shorter_than_a_stair_stays_at_the_start():
    assert [temperature(step, 60, PUBLISHED) for step in (0, 59)] == [1, 1]
    constant = TemperatureSettings(0.7, 0.7, 1.0, 1)
    assert [temperature(step, 10, constant) for step in (0, 5, 9)] == [0.7] * 3
