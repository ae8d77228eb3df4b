import pytest

from morphoskel.errors import ConfigError
from morphoskel.surface.ponq import PRESETS, PonqSettings
from morphoskel.surface.ponq.settings import resolve_settings


def test_the_released_preset_is_that_of_the_released_program():
    assert resolve_settings("released") == PonqSettings(50_000, True, 200, 1e-3, 0.1, 128)
    assert PRESETS["released"].count_batch(10_000) == 1000


def test_the_sound_preset_follows_the_cloud():
    sound = resolve_settings("sound")
    assert [sound.count_sites(points) for points in (2000, 10_003)] == [500, 2500]
    assert [sound.count_batch(points) for points in (2000, 50_000)] == [2000, 10_000]
    assert not sound.with_replacement


def test_without_a_grid_the_ratio_of_sites_to_cells_is_the_released_one():
    released = PRESETS["released"]
    cells = PonqSettings().count_cells(released.sites)
    assert cells == pytest.approx(released.grid, rel=0.02)
    assert released.count_cells(500) == 128
    assert PonqSettings().count_cells(4) == 1


def test_only_given_values_replace_those_of_the_preset():
    changed = resolve_settings("released", sites=10, with_replacement=False, steps=None, sample_fraction=1.0)
    assert changed == PonqSettings(10, False, 200, 1e-3, 1.0, 128)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"sites": 3}, "sites must be at least 4, got 3"),
        ({"steps": -1}, "steps must be at least 0"),
        ({"grid": 0}, "grid must be at least 1"),
        ({"learning_rate": 0.0}, "learning_rate must be positive"),
        ({"sample_fraction": 1.5}, r"sample_fraction must lie in \(0, 1\], got 1.5"),
    ],
)
def test_a_value_out_of_range_is_refused(change, message):
    with pytest.raises(ConfigError, match=message):
        resolve_settings("sound", **change)


def test_an_unknown_preset_is_refused():
    with pytest.raises(ConfigError, match="no such preset 'fast'; legal are sound, released"):
        resolve_settings("fast")
