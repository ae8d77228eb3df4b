"""Seeds that depend on what is computed, never on where or when.

A result must not change with the shard size, the order of the shapes or the number of cores. So no generator
is ever shared: each is derived from the global seed, the shape's id and the name of the stage.
"""

import hashlib

import numpy as np


def derive_seed(seed: int, *names: str, bits: int = 63) -> int:
    """Return a seed for one stage of one shape.

    Parameters
    ----------
    seed
        The experiment's global seed.
    names
        What the seed is for, for example a shape id and a stage.
    bits
        Number of bits of the result, at most 256.

    Returns
    -------
    int
        In ``[1, 2**bits)``; the same arguments always give the same seed. Never 0, which some native
        libraries read as "unseeded".
    """
    message = "\x1f".join((str(seed), *names)).encode()
    value = int.from_bytes(hashlib.blake2b(message, digest_size=32).digest(), "big") >> (256 - bits)
    return max(value, 1)


def derive_generator(seed: int, *names: str) -> np.random.Generator:
    """Return a NumPy generator seeded by :func:`derive_seed`."""
    return np.random.default_rng(derive_seed(seed, *names))
