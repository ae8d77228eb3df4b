import hashlib
import http.server
import io
import logging
import threading
import urllib.error
import urllib.request
from http.client import HTTPMessage

import numpy as np
import pytest

from morphoskel.datasets.download import _Redirections, download
from morphoskel.errors import DatasetError

CONTENT = np.random.default_rng(6).bytes(1_000_000)
SUM = hashlib.sha256(CONTENT).hexdigest()


class Handler(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        server = self.server
        server.requests.append(self.headers.get("Range"))
        if self.path == "/moved":
            self.send_response(302)
            self.send_header("Location", server.location)
            self.end_headers()
            return
        if server.statuses:
            self.send_error(server.statuses.pop(0))
            return
        start = 0
        if server.ranges and "Range" in self.headers:
            start = int(self.headers["Range"].removeprefix("bytes=").removesuffix("-"))
            if start >= len(CONTENT):
                self.send_response(416)
                self.send_header("Content-Range", f"bytes */{len(CONTENT)}")
                self.end_headers()
                return
            self.send_response(206)
            shown = start + server.shift
            self.send_header("Content-Range", f"bytes {shown}-{len(CONTENT) - 1}/{len(CONTENT)}")
        else:
            self.send_response(200)
        if server.tell_length:
            self.send_header("Content-Length", server.length or str(len(CONTENT) - start))
        self.end_headers()
        part = server.drop_after.pop(0) if server.drop_after else len(CONTENT)
        self.wfile.write(CONTENT[start : start + part])

    def log_message(self, *_):
        pass


@pytest.fixture
def server(monkeypatch):
    for name in ("http_proxy", "HTTP_PROXY", "all_proxy", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as running:
        running.requests, running.statuses, running.drop_after = [], [], []
        running.ranges, running.tell_length, running.shift, running.location = True, True, 0, ""
        running.length = ""
        running.url = f"http://127.0.0.1:{running.server_port}/archive.zip"
        thread = threading.Thread(target=running.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield running
        running.shutdown()
        thread.join()


@pytest.fixture
def fetch(server, tmp_path):
    def run(url=None, sha256=SUM, **options):
        target = tmp_path / "sub" / "archive.zip"
        download(url or server.url, target, sha256=sha256, **({"progress": False, "backoff": 0.001} | options))
        return target

    return run


def names(tmp_path):
    return sorted(path.name for path in (tmp_path / "sub").iterdir())


@pytest.mark.parametrize("tell_length", [True, False])
def test_a_whole_file(server, fetch, tmp_path, tell_length):
    server.tell_length = tell_length
    assert fetch(sha256=SUM.upper()).read_bytes() == CONTENT
    assert names(tmp_path) == ["archive.zip"]


def test_a_file_that_is_there_is_not_fetched_again(server, fetch):
    fetch()
    fetch()
    assert server.requests == [None]


def test_a_wrong_file_that_is_there_is_left_alone(server, fetch):
    target = fetch()
    target.write_bytes(b"precious")
    with pytest.raises(DatasetError, match=f"expected sha256 {SUM}, found .*delete the file"):
        fetch()
    assert target.read_bytes() == b"precious"


def test_the_progress_bar(fetch, capsys, monkeypatch):
    monkeypatch.setattr("morphoskel.progress.shows_bars", lambda: True)
    fetch(progress=True)
    assert "fetch archive.zip:" in capsys.readouterr().err


def test_a_connection_that_drops_is_resumed(server, fetch, caplog):
    server.drop_after = [300_000, 0, 100_000]
    with caplog.at_level(logging.WARNING):
        assert fetch().read_bytes() == CONTENT
    assert server.requests == [None, "bytes=300000-", "bytes=300000-", "bytes=400000-"]
    assert "the connection ended at 300000 of 1000000 bytes" in caplog.text


def test_an_interrupted_run_is_resumed_by_the_next(server, fetch, tmp_path):
    server.drop_after = [300_000, 0]
    with pytest.raises(DatasetError, match=r"300000 bytes are kept in .*archive\.zip\.partial"):
        fetch(attempts=1)
    assert names(tmp_path) == ["archive.zip.partial"]
    assert fetch().read_bytes() == CONTENT
    assert server.requests[-1] == "bytes=300000-"


def test_a_server_without_ranges_starts_over(server, fetch):
    server.ranges = False
    server.drop_after = [300_000]
    assert fetch().read_bytes() == CONTENT
    assert server.requests == [None, "bytes=300000-"]


def test_a_server_that_sends_another_part_is_not_trusted(server, fetch):
    server.drop_after, server.shift = [300_000], 7
    assert fetch().read_bytes() == CONTENT
    assert server.requests == [None, "bytes=300000-", None]


def test_a_transfer_that_was_complete_but_for_its_name(server, fetch, tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/archive.zip.partial").write_bytes(CONTENT)
    assert fetch().read_bytes() == CONTENT
    assert server.requests == ["bytes=1000000-"]


def test_a_partial_file_that_is_too_long_is_dropped(server, fetch, tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/archive.zip.partial").write_bytes(CONTENT + b"x")
    assert fetch().read_bytes() == CONTENT
    assert server.requests == ["bytes=1000001-", None]


def test_a_wrong_checksum_keeps_nothing(fetch, tmp_path):
    with pytest.raises(DatasetError, match=f"expected sha256 {'0' * 64}, found {SUM}; the file was not kept"):
        fetch(sha256="0" * 64)
    assert names(tmp_path) == []


def test_without_checksum_the_file_waits_to_be_confirmed(server, fetch, tmp_path):
    for _ in range(2):
        with pytest.raises(DatasetError, match=f"Its sha256 is {SUM}. If you trust this file"):
            fetch(sha256=None)
    assert names(tmp_path) == ["archive.zip.unverified"]
    assert fetch().read_bytes() == CONTENT
    assert names(tmp_path) == ["archive.zip"]
    assert server.requests == [None]


def test_a_refusal_is_final(server, fetch, tmp_path):
    server.statuses = [404] * 9
    with pytest.raises(DatasetError, match="cannot be fetched \\(HTTP 404 Not Found\\)"):
        fetch()
    assert len(server.requests) == 1
    assert names(tmp_path) == []


def test_a_busy_server_is_asked_again(server, fetch):
    server.statuses = [503, 429]
    assert fetch().read_bytes() == CONTENT
    server.statuses = [503] * 9


def test_patience_ends(server, fetch):
    server.statuses = [503] * 9
    with pytest.raises(DatasetError, match="HTTP 503"):
        fetch(attempts=3)
    assert len(server.requests) == 3


def test_nobody_listens(fetch, server):
    with pytest.raises(DatasetError, match="refused"):
        fetch(f"http://127.0.0.1:{unused_port()}/a.zip", attempts=2)


def unused_port():
    with http.server.HTTPServer(("127.0.0.1", 0), Handler) as closed:
        return closed.server_port


def test_redirections_stay_with_http(server, fetch, tmp_path):
    server.location = "/archive.zip"
    moved = server.url.replace("archive.zip", "moved")
    assert fetch(moved).read_bytes() == CONTENT
    (tmp_path / "sub/archive.zip").unlink()
    secret = tmp_path / "secret"
    secret.write_text("secret")
    for server.location in (secret.as_uri(), "ftp://127.0.0.1/a.zip"):
        with pytest.raises(DatasetError, match="cannot be fetched"):
            fetch(moved, attempts=1)
    assert names(tmp_path) == []


def test_redirections_do_not_leave_https():
    handler, headers = _Redirections(), HTTPMessage()
    request = urllib.request.Request("https://example.org/a.zip")
    followed = handler.redirect_request(request, io.BytesIO(), 302, "Found", headers, "https://example.org/b.zip")
    assert followed.full_url == "https://example.org/b.zip"
    for address in ("http://example.org/b.zip", "HTTP://example.org/b.zip"):
        with pytest.raises(urllib.error.HTTPError, match="leaves HTTPS"):
            handler.redirect_request(request, io.BytesIO(), 302, "Found", headers, address)


def test_redirections_without_end(server, fetch):
    server.location = "/moved"
    with pytest.raises(DatasetError, match="cannot be fetched"):
        fetch(server.url.replace("archive.zip", "moved"))
    assert len(server.requests) < 20


def test_a_damaged_beginning_is_found_and_fetched_anew(server, fetch, tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/archive.zip.partial").write_bytes(bytes(300_000))
    with pytest.raises(DatasetError, match="the file was not kept"):
        fetch()
    assert names(tmp_path) == []
    assert fetch().read_bytes() == CONTENT


@pytest.mark.parametrize("tell_length", [True, False])
def test_a_server_that_sends_too_much(server, fetch, tmp_path, tell_length):
    server.tell_length = tell_length
    with pytest.raises(DatasetError, match="more than 400000 bytes"):
        fetch(largest=400_000)
    assert names(tmp_path) == []
    assert fetch(largest=len(CONTENT)).read_bytes() == CONTENT


def test_a_transfer_that_ends_early_without_a_length_is_not_taken_for_whole(server, fetch, tmp_path):
    server.tell_length, server.drop_after = False, [300_000]
    with pytest.raises(DatasetError, match="the file was not kept"):
        fetch()
    assert fetch().read_bytes() == CONTENT


def test_a_length_that_is_no_number(server, fetch):
    server.length = "many"
    assert fetch().read_bytes() == CONTENT


def test_a_password_is_not_repeated(fetch, server):
    with pytest.raises(DatasetError, match="holds a user name or password") as caught:
        fetch(server.url.replace("http://", "http://ada:secret@"))
    assert "secret" not in str(caught.value)
    assert server.requests == []


@pytest.mark.parametrize("url", ["file:///etc/passwd", "ftp://example.org/a.zip", "archive.zip", "https://", "data:,a"])
def test_other_schemes_are_refused(fetch, url):
    with pytest.raises(DatasetError, match="only addresses http"):
        fetch(url)


@pytest.mark.parametrize("sha256", ["", "123", "g" * 64])
def test_what_is_no_checksum_is_refused(fetch, sha256, server):
    with pytest.raises(DatasetError, match="expected 64 hexadecimal digits"):
        fetch(sha256=sha256)
    assert server.requests == []
