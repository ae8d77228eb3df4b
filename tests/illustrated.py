"""Small illustrations, made once for all tests."""

from functools import cache

from morphoskel.reporting.illustrate import Limits, illustrate
from morphoskel.reporting.illustrated_shapes import named_shape
from morphoskel.reporting.illustration import Illustration

SEED = 3


@cache
def illustrated(name: str = "box", mode: str = "random", count: int = 3000, points: int = 50) -> Illustration:
    return illustrate(
        named_shape(name),
        name=name,
        candidates={"mode": mode, "count": count},
        k=20,
        points=points,
        seed=SEED,
        is_closed=True,
        limits=Limits(cloud=500, candidates=1000, inner=1200),
        threads=1,
    )
