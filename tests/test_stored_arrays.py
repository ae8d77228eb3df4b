import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from morphoskel.errors import InputError
from morphoskel.formats.stored_arrays import parse_npy_array, parse_npz_arrays, read_arrays

TYPES = st.sampled_from(["<f8", ">f4", "<f2", "<i8", ">u2", "|b1", "<U5"])
SHAPES = array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5)


def npy(array):
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


@settings(max_examples=60, deadline=None)
@given(TYPES.flatmap(lambda kind: arrays(kind, SHAPES)), st.booleans())
def test_arrays_come_back_exactly(array, transposed):
    array = array.T if transposed else array
    back = parse_npy_array(npy(array))
    assert back.dtype == array.dtype
    np.testing.assert_array_equal(back, array)
    assert back.flags.owndata
    assert back.flags.writeable


@settings(max_examples=30, deadline=None)
@given(st.dictionaries(st.sampled_from(["points", "radii", "edges"]), arrays("<f8", SHAPES)), st.booleans())
def test_archives_come_back_exactly(mapping, compressed):
    stream = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(stream, **mapping)
    back = parse_npz_arrays(stream.getvalue())
    assert back.keys() == mapping.keys()
    for name, array in mapping.items():
        np.testing.assert_array_equal(back[name], array)


def test_room_is_made_only_for_what_is_there():
    content = npy(np.zeros((2, 3)))
    start = content.index(b"(2, 3), }")
    shape = b"(2000000000000, 3), }"
    with pytest.raises(InputError, match=r"\(2000000000000, 3\), 48000000000000 bytes, but 48 bytes follow"):
        parse_npy_array(content[:start] + shape + content[start + len(shape) :])


@pytest.mark.parametrize(
    ("layout", "message"),
    [
        ({"sizes": ("f", "N")}, "'sizes' is missing; it holds points, labels"),
        ({"points": ("i", "N3")}, r"points: expected shape \(4, 3\) and a type of kind 'i', got \(4, 3\) and float64"),
        ({"points": ("f", "N4")}, r"points: expected shape \(4, 4\)"),
        ({"points": ("f", "N3"), "labels": ("i", "M")}, None),
        ({"points": ("f", "N3"), "labels": ("i", "N")}, r"labels: expected shape \(4\).*got \(5,\)"),
    ],
)
def test_arrays_are_what_is_expected(layout, message, tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, points=np.zeros((4, 3)), labels=np.arange(5))
    if message is None:
        assert read_arrays(path, layout).keys() == {"points", "labels"}
    else:
        with pytest.raises(InputError, match=rf"a\.npz: .*{message}"):
            read_arrays(path, layout)
