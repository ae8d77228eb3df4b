"""Choose points by logits, softly to train and one by one to sample.

Source: Jang et al., *Categorical Reparameterization with Gumbel-Softmax*, ICLR 2017.
"""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor

from morphoskel.networks.skeleton_sampler_settings import TemperatureSettings


def gumbel_noise(shape: Sequence[int], generator: torch.Generator | None, device: torch.device | str = "cpu") -> Tensor:
    """Draw from the standard Gumbel distribution.

    Parameters
    ----------
    shape
        Of the result.
    generator
        On the device; ``None`` takes torch's own, for a training step that has seeded it.
    device
        Where to draw.

    Returns
    -------
    Tensor
        Float32, finite.
    """
    exponential = torch.empty(tuple(shape), device=device).exponential_(generator=generator)
    return -exponential.clamp_(min=torch.finfo(exponential.dtype).tiny).log_()


def gumbel_softmax(logits: Tensor, temperature: float, noise: Tensor) -> Tensor:
    """Return weights that approach a one-hot draw as the temperature falls.

    Parameters
    ----------
    logits
        ``(..., N)`` float, unnormalised log-probabilities.
    temperature
        More than 0.
    noise
        ``(..., N)``, see :func:`gumbel_noise`.

    Returns
    -------
    Tensor
        ``(..., N)``, the last axis sums to 1. At any temperature the largest weight is where ``logits + noise`` is
        largest, which is point n with the probability ``softmax(logits)[n]``.
    """
    return ((logits + noise) / temperature).softmax(dim=-1)


@torch.no_grad()
def draw_indices(logits: Tensor, generator: torch.Generator | None) -> Tensor:
    """Draw one point for each output, independently of the other outputs.

    Parameters
    ----------
    logits
        ``(B, M, N)`` float.
    generator
        As in :func:`gumbel_noise`.

    Returns
    -------
    Tensor
        ``(B, M)`` int64. Outputs may draw the same point.
    """
    return (logits + gumbel_noise(logits.shape, generator, logits.device)).argmax(dim=-1)


def best_indices(logits: Tensor) -> Tensor:
    """Return the most probable point of each output, ``(B, M)`` int64 of ``(B, M, N)``; points may repeat."""
    return logits.argmax(dim=-1)


def temperature(step: int, total_steps: int, schedule: TemperatureSettings) -> float:
    """Return the temperature of a training step.

    Parameters
    ----------
    step
        From 0.
    total_steps
        Steps of the whole training, at least 1.
    schedule
        How it falls: exponentially, in stairs, down to its end.

    Returns
    -------
    float
        Between the schedule's start and end.
    """
    last_change = step - step % schedule.every
    progress = last_change / (schedule.annealed_share * total_steps)
    current: float = schedule.start * (schedule.end / schedule.start) ** progress
    return max(current, schedule.end)
