"""The skeleton methods by name, and what each needs."""

import difflib

from morphoskel.errors import ConfigError

MORPHOLOGICAL = ("ms3d", "ms3d_coverage")
"""MorphoSkel3D: maximal balls of smallest residue, as in the paper, or those that together explain the cloud."""

SURFACE_METHODS = (*MORPHOLOGICAL, "coverage_axis")
"""Methods that choose balls among the points inside a closed surface."""

CLOUD_METHODS = ("l1_medial", "dpc", "point2skeleton")
"""Methods that read the cloud alone."""

METHODS = SURFACE_METHODS + CLOUD_METHODS
"""All skeleton methods."""

RANKED = frozenset({"ms3d_coverage", "coverage_axis"})
"""Methods whose first n balls are the method's answer for n balls, for each is chosen in view of those before it. Those
of ``ms3d`` are ordered by residue alone; its first ones may all lie in one part of the shape."""


def check_method(method: str) -> None:
    """Refuse a name that is no skeleton method.

    Raises
    ------
    ConfigError
        Naming the legal ones and the nearest match.
    """
    if method not in METHODS:
        nearest = difflib.get_close_matches(str(method), METHODS, n=1, cutoff=0.5)
        guess = f"did you mean {nearest[0]!r}? " if nearest else ""
        raise ConfigError(f"method: no such skeleton method {method!r}; {guess}Legal: {', '.join(METHODS)}")
