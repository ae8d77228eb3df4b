"""The point samplers by name, and what each needs."""

import difflib

from morphoskel.errors import ConfigError

TRAINING_FREE = ("random", "fps", "lfs")
"""Random points, farthest points, and farthest points weighted by the local feature size."""

GENERATORS = ("snet", "samplenet", "metasampler")
"""Networks that generate points, each of which is then replaced by the nearest point of the cloud."""

PRIORS = ("skeleton_aware", "ms3d", "dpc", "l1_medial", "uniform", "shuffled")
"""The skeleton-aware network by its prior: the local feature size to a skeleton, which is learned in
``skeleton_aware``; equal weights; or the weights of ``ms3d`` in random order."""

LEARNED = GENERATORS + PRIORS
"""Samplers that need a trained network."""

SAMPLERS = TRAINING_FREE + LEARNED
"""All samplers."""

LEARNED_SKELETON = "skeleton_aware"
"""The skeleton that a network predicts; all others are skeleton methods."""

SKELETON_OF = {
    "lfs": "ms3d",
    "skeleton_aware": LEARNED_SKELETON,
    "ms3d": "ms3d",
    "dpc": "dpc",
    "l1_medial": "l1_medial",
    "shuffled": "ms3d",
}
"""The skeleton to which a sampler measures the local feature size; the samplers that are left out need none."""


def check_sampler(sampler: str) -> None:
    """Refuse a name that is no sampler.

    Raises
    ------
    ConfigError
        Naming the legal ones and the nearest match.
    """
    if sampler not in SAMPLERS:
        nearest = difflib.get_close_matches(str(sampler), SAMPLERS, n=1, cutoff=0.5)
        guess = f"did you mean {nearest[0]!r}? " if nearest else ""
        raise ConfigError(f"sampler: no such sampler {sampler!r}; {guess}Legal: {', '.join(SAMPLERS)}")
