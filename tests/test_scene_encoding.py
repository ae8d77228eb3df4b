import base64
import json
import zlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from morphoskel.reporting.scene import Layer, Scalar, Scene
from morphoskel.reporting.scene_encoding import colour_table, encode_scenes

RANDOM = np.random.default_rng(0)
PLACES = RANDOM.normal(size=(20, 3)) * [1, 1e-3, 1e5]


def encoded(*layers):
    return json.loads(encode_scenes([Scene("s", layers)]))["scenes"][0]["layers"]


def unpack(text, kind):
    """Undo the packing number by number: its bytes lie one plane apart."""
    planes = zlib.decompress(base64.b64decode(text))
    width = np.dtype(kind).itemsize
    count = len(planes) // width
    return np.array([np.frombuffer(planes[i::count], dtype=kind)[0] for i in range(count)])


def test_positions_are_kept_to_a_65535th_of_the_box():
    [layer] = encoded(Layer("a", "points", PLACES))
    lower, upper = np.array(layer["lower"]), np.array(layer["upper"])
    np.testing.assert_array_equal([lower, upper], [PLACES.min(axis=0), PLACES.max(axis=0)])
    decoded = lower + unpack(layer["positions"], "<u2").reshape(-1, 3) / 65535 * (upper - lower)
    assert (np.abs(decoded - PLACES) <= 0.5001 * (upper - lower) / 65535).all()
    assert layer["count"] == 20


@given(arrays(np.float64, (4, 3), elements=st.floats(-1e308, 1e308)))
def test_no_box_overflows(positions):
    [layer] = encoded(Layer("a", "points", positions))
    steps = unpack(layer["positions"], "<u2").reshape(-1, 3)
    extended = np.ptp(positions / 2, axis=0) > 0
    np.testing.assert_array_equal(steps.max(axis=0), 65535 * extended)
    np.testing.assert_array_equal(steps.min(axis=0), 0)


def test_elements_and_radii_are_kept_exactly():
    triangles = RANDOM.integers(0, 20, (30, 3))
    radii = RANDOM.random(20)
    mesh, balls = encoded(
        Layer("a", "mesh", PLACES, elements=triangles), Layer("b", "balls", PLACES, radii=radii, visible=False)
    )
    np.testing.assert_array_equal(np.cumsum(unpack(mesh["elements"], "<i4")), triangles.reshape(-1))
    np.testing.assert_array_equal(unpack(balls["radii"], "<f4"), radii.astype(np.float32))
    assert (mesh["visible"], balls["visible"]) == (True, False)


def test_values_beyond_the_limits_get_the_colour_of_the_end():
    values = np.linspace(-1, 3, 20)
    [layer] = encoded(
        Layer("a", "points", PLACES, scalars=[Scalar("height", values, (0, 2)), Scalar("same", 0 * values)])
    )
    height, same = layer["scalars"]
    decoded = unpack(height["values"], "<u2") / 65535 * 2
    np.testing.assert_allclose(decoded, np.clip(values, 0, 2), atol=2e-5)
    assert (height["below"], height["above"], same["below"], same["above"]) == (True, True, False, False)
    assert not unpack(same["values"], "<u2").any()


def test_names_cannot_end_the_element_that_holds_them():
    name = "</script><!-- <b> \u2028 é"
    text = encode_scenes([Scene(name, [Layer(name, "points", PLACES)])])
    assert "<" not in text
    scene = json.loads(text)["scenes"][0]
    assert (scene["name"], scene["layers"][0]["name"]) == (name, name)


def test_equal_scenes_give_equal_text():
    assert len({encode_scenes([Scene("s", [Layer("a", "points", PLACES)])]) for _ in range(2)}) == 1


def test_colours_grow_lighter_all_the_way():
    table = colour_table()
    assert json.loads(encode_scenes([]))["colours"] == [bytes(row).hex() for row in table]
    linear = np.where(table / 255 <= 0.04045, table / 255 / 12.92, ((table / 255 + 0.055) / 1.055) ** 2.4)
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    assert len(table) == 256
    assert (np.diff(luminance) > -0.002).all()
    assert luminance[-1] == pytest.approx(luminance.max())
