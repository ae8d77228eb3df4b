from pathlib import Path

import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.exporting.single_precision import as_float32


def test_values_are_rounded_to_little_endian_float32():
    values = np.array([[1 / 3, 1e-60, -3e38]])
    narrow = as_float32(values, Path("a.ply"))
    assert narrow.dtype.str == "<f4"
    assert narrow.tolist() == values.astype(np.float32).tolist()


@pytest.mark.parametrize("value", [1e39, -1e39, np.inf])
def test_what_is_too_large_is_refused(value):
    with pytest.raises(InputError, match=r"a\.ply: .* range of float32"):
        as_float32(np.array([[0.0, value, 0.0]]), Path("a.ply"))
