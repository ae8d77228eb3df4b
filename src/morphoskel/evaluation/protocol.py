"""The two ways to turn distances into a number of a table, which are never mixed in one column."""

from typing import Literal, cast, get_args

from morphoskel.errors import InputError

EvaluationProtocol = Literal["correct", "released"]
"""``correct`` divides every sum by the number of its terms. ``released`` repeats two slips of the evaluation that the
paper's authors released: a mean over ``n`` shapes is divided by ``n + 1``, and the sum of the distances from the
spheres to the surface is divided by the number of surface points."""


def check_protocol(protocol: str) -> EvaluationProtocol:
    """Return `protocol`, or raise :class:`InputError` if there is no protocol of that name."""
    if protocol not in get_args(EvaluationProtocol):
        raise InputError(f"protocol: expected one of {', '.join(get_args(EvaluationProtocol))}, got {protocol!r}")
    return cast(EvaluationProtocol, protocol)
