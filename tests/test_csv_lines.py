import csv
import io

from morphoskel.csv_lines import QUOTED_ENDS, LineFeeds


def test_a_carriage_return_is_quoted_and_rows_end_in_a_line_feed():
    stream = io.StringIO(newline="")
    csv.writer(LineFeeds(stream), lineterminator=QUOTED_ENDS).writerows([["a\r", "b"], ["c\r\n", "d"]])
    assert stream.getvalue() == '"a\r",b\n"c\r\n",d\n'
    assert list(csv.reader(io.StringIO(stream.getvalue(), newline=""))) == [["a\r", "b"], ["c\r\n", "d"]]
