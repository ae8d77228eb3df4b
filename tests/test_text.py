import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.text import parse_text

ROWS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.5]]


def text(rows, separator=" "):
    return "\n".join(separator.join(map(str, row)) for row in rows).encode()


@pytest.mark.parametrize(
    "content",
    [
        text(ROWS),
        text(ROWS, ","),
        text(ROWS, ", "),
        text(ROWS).replace(b"\n", b"\r\n"),
        b"# x y z\n\n// by hand\n" + text(ROWS) + b"\n\n",
        b"4\n" + text(ROWS),
    ],
)
def test_points_in_all_spellings(content):
    cloud = parse_text(content)
    np.testing.assert_array_equal(cloud.points, ROWS)
    assert cloud.normals is None
    assert cloud.labels is None


def test_columns_tell_normals_and_labels():
    normals = [[0, 0, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]]
    six = parse_text(text(np.hstack([ROWS, normals])))
    np.testing.assert_array_equal(six.normals, normals)
    assert six.labels is None
    seven = parse_text(text(np.hstack([ROWS, normals, [[4], [5], [4], [4]]])))
    np.testing.assert_array_equal(seven.normals, normals)
    np.testing.assert_array_equal(seven.labels, [4, 5, 4, 4])
    four = parse_text(text(np.hstack([ROWS, [[4], [5], [4], [4]]])))
    assert four.normals is None
    np.testing.assert_array_equal(four.labels, [4, 5, 4, 4])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"# nothing\n", "got 0"),
        (b"1 2\n3 4\n", r"expected 3 \(x y z\), .* columns of numbers, got 2"),
        (text(np.ones((4, 5))), "got 5"),
        (text([*ROWS, [1, 2]]), "line 5: expected 3 numbers, got 2"),
        (text([*ROWS, [1, 2, "x"]]), "line 5: expected only numbers"),
        (text([*ROWS, [1, 2, "nan"]]), "NaN"),
        (text([*ROWS[:3], ROWS[0]]), "3 of them distinct"),
        (text([[*row, 0.5] for row in ROWS]), "labels: expected whole numbers, got 0.5"),
        (b"5\n" + text(ROWS), "declares 5 points, but 4 follow"),
        (b"3\n" + text(ROWS), "declares 3 points, but 4 follow"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_text(content)
