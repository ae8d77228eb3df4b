import pytest

from morphoskel.config import compose
from morphoskel.datasets.address import archive_name, check_address
from morphoskel.errors import ConfigError


@pytest.mark.parametrize("url", ["https://example.org/a.zip", "http://127.0.0.1:80/a?b=c", "https://example.org"])
def test_web_addresses(url):
    assert check_address(url) == url


@pytest.mark.parametrize(
    "url", ["file:///etc/passwd", "ftp://example.org/a", "a.zip", "https://", "data:,a", "//a/b", "http://a:b/", "http://["]
)  # fmt: skip
def test_other_addresses(url):
    with pytest.raises(ValueError, match=r"expected http|only addresses http"):
        check_address(url)


@pytest.mark.parametrize("url", ["https://ada:secret@example.org/a.zip", "https://secret@example.org/a.zip"])
def test_passwords_are_neither_taken_nor_repeated(url):
    with pytest.raises(ValueError, match=r"example\.org holds a user name or password") as caught:
        check_address(url)
    assert "secret" not in str(caught.value)
    with pytest.raises(ConfigError, match=r"dataset\.url") as refused:
        compose(["dataset=modelnet40", f"dataset.url='{url}'"])
    assert "secret" not in str(refused.value)


@pytest.mark.parametrize(
    ("url", "name"),
    [
        ("https://example.org/data/modelnet40.zip", "modelnet40.zip"),
        ("https://example.org/a.zip?token=x#y", "a.zip"),
        ("https://example.org/a%20b%2Fc.zip", "c.zip"),
        ("https://example.org/..", "archive"),
        ("https://example.org/", "archive"),
        ("https://example.org/%2e%2e/-rf", "rf"),
        ("https://example.org/$(x).zip", "__x_.zip"),
    ],
)
def test_names_of_archives(url, name):
    assert archive_name(url) == name
