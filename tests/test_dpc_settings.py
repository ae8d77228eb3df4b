import pytest

from morphoskel.errors import ConfigError
from morphoskel.skeleton.dpc import DeepPointsSettings


def test_defaults_and_bounds_are_legal():
    DeepPointsSettings()
    DeepPointsSettings(samples=4, untested_steps=0, iterations=0, smoothing_angle=180.0, cooling=0.0, radii="deep_link")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"samples": 3}, "samples: expected a whole number from 4, got 3"),
        ({"untested_steps": -1}, "untested_steps: expected a whole number from 0"),
        ({"max_steps": 2.5}, "max_steps: expected a whole number from 1, got 2.5"),
        ({"cooling": -0.1}, "cooling: expected a finite number that is not negative"),
        ({"radius": float("nan")}, "radius: expected a finite number"),
        ({"step": 0.0}, "step: expected a number greater than 0"),
        ({"step": "0.2"}, "step: expected a finite number"),
        ({"stop_angle": 181.0}, "stop_angle: expected an angle from 0 to 180 degrees"),
        ({"radii": "largest"}, "radii: expected one of .*deep_link.*, got 'largest'"),
        ({"repulsion_distance": "manhattan"}, "repulsion_distance: expected one of .*ellipsoid"),
    ],
)
def test_illegal_values_are_named(values, message):
    with pytest.raises(ConfigError, match=message):
        DeepPointsSettings(**values)
