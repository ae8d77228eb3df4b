import fcntl
import logging
import multiprocessing
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from types import SimpleNamespace

import pytest

from morphoskel import progress
from morphoskel.progress import count_up, track


@pytest.fixture
def clock(monkeypatch, caplog):
    """Return a clock that only the test moves."""
    now = SimpleNamespace(seconds=100.0)
    monkeypatch.setattr(progress, "time", SimpleNamespace(monotonic=lambda: now.seconds))
    caplog.set_level(logging.INFO, "morphoskel.progress")
    return now


def walk(clock, seconds, items, **options):
    for _ in track(items, "dilate", **options):
        clock.seconds += seconds


def test_items_come_unchanged():
    assert list(track("abc", "spell", unit="letter")) == ["a", "b", "c"]
    assert list(track(iter([1, 2]), "count")) == [1, 2]


def test_short_loops_leave_nothing_in_the_log(clock, caplog):
    walk(clock, 0.0019, range(1000))
    assert caplog.messages == []


def test_long_loops_log_every_tenth_and_their_end(clock, caplog):
    walk(clock, 1.0, range(200))
    assert len(caplog.messages) == 10
    assert caplog.messages[0] == "dilate: 20 shapes of 200 (10 %), 1.0 s/shape, about 3 min left"
    assert caplog.messages[-1] == "dilate: 200 shapes in 3 min 20 s, 1.0 s/shape"


def test_lines_are_seconds_apart_however_fast_the_loop_is(clock, caplog):
    walk(clock, 0.12, range(100))  # a tenth takes 1.2 s
    assert [line.split()[1] for line in caplog.messages] == ["42", "84", "100"]
    assert "8.3 shapes/s" in caplog.messages[0]


def test_without_a_total_there_is_a_line_every_half_minute(clock, caplog):
    walk(clock, 10.0, iter(range(7)), unit="file")
    assert caplog.messages[0] == "dilate: 3 files, 10.0 s/file"
    assert len(caplog.messages) == 3


def test_bytes_that_were_there_before_do_not_count_for_the_speed(clock, caplog):
    with count_up("fetch", unit="B", total=100_000_000, start=40_000_000) as advance:
        for _ in range(3):
            clock.seconds += 10
            advance(20_000_000)
    assert caplog.messages[0] == "fetch: 60.0 MB of 100.0 (60 %), 2.0 MB/s, about 20 s left"
    assert caplog.messages[-1] == "fetch: 100.0 MB in 30 s, 2.0 MB/s"


def test_nothing_is_shown_where_it_is_not_wanted(clock, caplog, capfd):
    walk(clock, 5.0, range(10), show=False)
    assert caplog.messages == []
    assert capfd.readouterr() == ("", "")


def test_an_error_passes_through_and_no_end_is_claimed(clock, caplog):
    def run():
        for item in track(range(4), "dilate"):
            clock.seconds += 10
            assert item < 2

    with pytest.raises(AssertionError):
        run()
    assert len(caplog.messages) == 2
    assert all(" left" in line for line in caplog.messages)


def test_workers_leave_it_to_the_process_that_waits_for_them():
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        assert pool.apply(_lines_of_a_worker) == []


def _lines_of_a_worker():
    lines = []
    handler = logging.Handler()
    handler.emit = lines.append
    progress.logger.addHandler(handler)
    progress.logger.setLevel(logging.INFO)
    progress.SILENT_SECONDS = -1.0
    list(track(range(3), "work"))
    return lines


LOOP = """
import logging, time
from morphoskel.logs import log_to
from morphoskel.progress import track
import morphoskel.progress as progress
import sys
log_to(sys.argv[1])
progress.SILENT_SECONDS = 0.05
progress.LINE_SECONDS = 0.0
for item in track(range(4), "dilate"):
    time.sleep(0.15)
    if item == 2:
        logging.getLogger("morphoskel").warning("one is odd")
"""


def test_a_job_without_a_terminal_draws_no_bar(tmp_path):
    done = subprocess.run([sys.executable, "-c", LOOP, tmp_path / "log"], capture_output=True, text=True, check=True)
    assert done.stderr.splitlines()[-1].endswith("one is odd")
    assert len(done.stderr.splitlines()) == 1
    assert "INFO morphoskel.progress: dilate: 4 shapes in" in (tmp_path / "log").read_text()


def test_a_terminal_has_a_bar_and_messages_on_lines_of_their_own(tmp_path):
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 24, 100, 0, 0))
    subprocess.run([sys.executable, "-c", LOOP, tmp_path / "log"], stderr=theirs, check=True)
    os.close(theirs)
    shown = b""
    try:
        while block := os.read(ours, 1 << 16):
            shown += block
    except OSError:  # the end of a terminal
        pass
    os.close(ours)
    assert "dilate: 100%" in shown.decode() or "dilate:  75%" in shown.decode()
    assert "1 shape of 4" not in shown.decode()  # the bar says it
    parts = re.split(r"[\r\n]", shown.decode())
    assert any(part.endswith("WARNING morphoskel: one is odd") and "dilate" not in part for part in parts)
    assert parts[-1].strip() == ""  # the bar is gone
    assert "3 shapes of 4" in (tmp_path / "log").read_text()
