import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.lines import Line, parse_count, parse_numbers, parse_table, shorten, significant_lines


def test_lines_keep_their_numbers_and_lose_comments_blanks_and_windows_ends():
    lines = significant_lines(b"# head\r\n1 2\r\n\r\n3 4 # tail\r\n")
    assert lines == [Line(2, "1 2"), Line(4, "3 4")]


def test_a_byte_order_mark_is_no_data():
    assert significant_lines("\ufeff1 2".encode()) == [Line(1, "1 2")]


def test_binary_content_is_refused():
    with pytest.raises(InputError, match="binary data"):
        significant_lines(b"1 2\0\0")


@pytest.mark.parametrize("text", ["1 2.5 -3e2", "1,2.5,-3e2", "1; 2.5;\t-3e2"])
def test_separators(text):
    np.testing.assert_array_equal(parse_table([Line(1, text)]), [[1, 2.5, -300]])


def test_no_lines_give_an_empty_table_of_the_right_width():
    assert parse_table([], 3).shape == (0, 3)


def test_errors_name_the_line():
    with pytest.raises(InputError, match="line 7: expected 2 numbers, got 3"):
        parse_table([Line(5, "1 2"), Line(7, "1 2 3")])
    with pytest.raises(InputError, match="line 7: expected only numbers: '1 x'"):
        parse_table([Line(5, "1 2"), Line(7, "1 x")])
    with pytest.raises(InputError, match="line 3"):
        parse_numbers(Line(3, "a"), ["a"])


@pytest.mark.parametrize("field", ["-1", "1.0", "", "x", "²"])
def test_a_count_is_a_whole_number(field):
    assert parse_count(Line(1, ""), "12", "points") == 12
    with pytest.raises(InputError, match="line 1: expected the number of points"):
        parse_count(Line(1, ""), field, "points")


def test_long_text_is_cut():
    assert shorten("abc") == "'abc'"
    assert shorten("x" * 100) == "'" + "x" * 60 + "...'"
