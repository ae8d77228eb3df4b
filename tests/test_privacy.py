import pytest

from morphoskel.reporting.page.privacy import mask_values, without_absolute_paths


@pytest.mark.parametrize(
    ("text", "masked"),
    [
        ("/home/ada/shapes/chair.ply: no points", "…/chair.ply: no points"),
        ("error:/srv/data", "error:…/data"),
        ("in '/a/b c'", "in '…/b c'"),
        (r"C:\Users\ada\x.off is open", "…/x.off is open"),
        ("~ada/x and ~/y", "…/x and …/y"),
        ("file:///home/ada/x", "…/x"),
        ("see https://ada:key@example.org/home/ada, please", "see https://example.org/home/ada, please"),
        ("https://example.org/a.zip?key=secret&b=c", "https://example.org/a.zip?…"),
        ("resources/data/chair.ply, a/b, and/or, 1/2, 3 / 4, n/a", None),
        ("…/chair.ply", None),
        ("ratio ~ 5, a 10 % share", None),
    ],
)
def test_only_absolute_paths_are_masked(text, masked):
    assert without_absolute_paths(text) == (text if masked is None else masked)


def test_masked_text_stays_as_it_is():
    once = without_absolute_paths("/home/ada/x.ply and ~/y and file:///z/w")
    assert without_absolute_paths(once) == once


def test_values_at_any_depth_and_paths_with_spaces():
    values = {"root": "/home/ada/My Data", "url": None, "list": ["resources/x", "/a/b", 3, True], "/k/l": {"a": 1.5}}
    assert mask_values(values) == {
        "root": "…/My Data", "url": None, "list": ["resources/x", "…/b", 3, True], "…/l": {"a": 1.5}
    }  # fmt: skip
