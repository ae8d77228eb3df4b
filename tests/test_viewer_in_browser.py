"""The page in a headless Chromium with WebGL in software."""

import numpy as np
import pytest
from browser import SOFTWARE_WEBGL, WITHOUT_WEBGL, Browser, find_browser
from coloured import SKELETON, SURFACE
from solids import sphere_cloud

from morphoskel.reporting.scene import Scene
from morphoskel.reporting.scene_layers import cloud_layer, mesh_layer, skeleton_layers
from morphoskel.reporting.viewer import viewer_page

pytestmark = pytest.mark.skipif(
    find_browser() is None,
    reason="chromium or chromedriver is absent; apt-get install --no-install-recommends chromium chromium-driver",
)

CANVAS, BOXES = ".mv-canvas", ".mv-layers input[type=checkbox]"


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    layers = [*skeleton_layers(SKELETON), mesh_layer(SURFACE), cloud_layer(sphere_cloud(300), tone="strong")]
    path = tmp_path_factory.mktemp("viewer") / "page.html"
    path.write_text(viewer_page([Scene("one", layers), Scene("two", layers[:1])], "Shapes"), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def browser():
    with Browser(*SOFTWARE_WEBGL) as browser:
        yield browser


@pytest.fixture
def view(browser, page):
    browser.complaints()
    browser.open(page, 800, 500)
    yield browser
    assert browser.complaints() == []


def differing(first, second):
    """Share of the pixels that differ visibly, without the margin, where the focus is shown."""
    return (np.abs(first.astype(int) - second)[8:-8, 8:-8].max(axis=2) > 8).mean()


def test_something_is_drawn_and_nothing_is_complained_of(view):
    picture = view.picture(CANVAS)
    assert differing(picture, np.broadcast_to(picture[9, 9], picture.shape)) > 0.1
    assert view.run("return document.querySelector('.mv-message').hidden")
    assert view.run("return performance.getEntriesByType('resource').length") == 0


def test_mouse_keys_and_button(view):
    start = view.picture(CANVAS)
    view.drag(CANVAS, 120, 40)
    turned = view.picture(CANVAS)
    assert differing(start, turned) > 0.02
    view.drag(CANVAS, 80, 0, button=2)
    assert differing(turned, view.picture(CANVAS)) > 0.02
    view.click(".mv-reset")
    assert differing(start, view.picture(CANVAS)) < 0.001
    for key in ("\ue012", "\ue013", "\ue014", "\ue015", "+", "-"):  # left, up, right, down
        view.type(CANVAS, key)
        assert differing(start, view.picture(CANVAS)) > 0.01, key
        view.type(CANVAS, "r")
        assert differing(start, view.picture(CANVAS)) < 0.001, key


def test_wheel_and_fingers(view):
    start = view.picture(CANVAS)
    view.command("Input.dispatchMouseEvent", type="mouseWheel", x=200, y=200, deltaX=0, deltaY=-300)
    view.rest()
    assert differing(start, view.picture(CANVAS)) > 0.05
    view.click(".mv-reset")
    for before, after in (
        ([(200, 200)], [(280, 220)]),  # one finger turns
        ([(200, 200), (240, 200)], [(160, 200), (300, 200)]),  # two fingers zoom
    ):
        for kind, places in (("touchStart", before), ("touchMove", after), ("touchEnd", [])):
            touches = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(places)]
            view.command("Input.dispatchTouchEvent", type=kind, touchPoints=touches)
        view.rest()
        assert differing(start, view.picture(CANVAS)) > 0.02, before
        view.click(".mv-reset")
        assert differing(start, view.picture(CANVAS)) < 0.001, before


def test_every_layer_can_be_switched(view):
    count = view.run(f"return document.querySelectorAll('{BOXES}').length")
    assert count == 5
    for index in range(count):
        before = view.picture(CANVAS)
        view.run(f"document.querySelectorAll('{BOXES}')[arguments[0]].click()", index)
        view.rest()
        if index not in (1, 2):  # sheets and curves are inside the balls, which are hidden by then
            assert differing(before, view.picture(CANVAS)) > 0.002, index
    for index in (1, 2):
        hidden = view.picture(CANVAS)
        view.run(f"document.querySelectorAll('{BOXES}')[arguments[0]].click()", index)
        view.rest()
        assert differing(hidden, view.picture(CANVAS)) > 0, index


def test_balls_are_coloured_by_what_the_reader_chooses(view):
    before = view.picture(CANVAS)
    assert view.run("return document.querySelector('.mv-bar').textContent").startswith("ball radius")
    choose = "const s = document.querySelector('.mv-row select'); s.value = '1'; s.dispatchEvent(new Event('change'))"
    view.run(choose)
    view.rest()
    assert differing(before, view.picture(CANVAS)) > 0.01
    assert view.run("return document.querySelector('.mv-bar').textContent").startswith("residue")


def test_the_surface_grows_opaque(view):
    before = view.picture(CANVAS)
    slider = "const s = [...document.querySelectorAll('[type=range]')].at(-1);"
    view.run(f"{slider} s.value = 1; s.dispatchEvent(new Event('input'))")
    view.rest()
    assert differing(before, view.picture(CANVAS)) > 0.1


def test_another_shape_keeps_the_direction_and_what_is_hidden(view):
    view.run(f"document.querySelector('{BOXES}').click()")
    choose = "const s = document.querySelector('.mv-scene select'); s.value = '1'; s.dispatchEvent(new Event('change'))"
    view.run(choose)
    view._wait_for(lambda: view.run(f"return document.querySelectorAll('{BOXES}').length") == 1, "no other shape")
    assert not view.run(f"return document.querySelector('{BOXES}').checked")
    assert view.run("return document.querySelector('.mv-canvas').ariaLabel") == "Shapes: two"


def test_nothing_is_drawn_while_nothing_changes(view):
    view.run("window.frames_asked = 0; const ask = requestAnimationFrame;"
             "window.requestAnimationFrame = (f) => { window.frames_asked++; return ask(f); };")  # fmt: skip
    view.run("return new Promise((done) => setTimeout(done, 500))")
    assert view.run("return window.frames_asked") == 0
    view.type(CANVAS, "+")
    assert view.run("return window.frames_asked") >= 1


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_it_fits_the_window_in_light_and_dark(browser, page, width, dark):
    browser.open(page, width, 844, dark=dark)
    assert browser.run("return document.documentElement.scrollWidth") <= width
    picture = browser.picture(CANVAS)
    assert picture.shape[1] > 0.6 * width
    assert (picture[9, 9].mean() < 100) == dark
    assert browser.complaints() == []


def test_the_colours_follow_a_change_of_preference(view):
    light = view.picture(CANVAS)
    view.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    view.rest()
    assert differing(light, view.picture(CANVAS)) > 0.9
    view.run("document.documentElement.dataset.theme = 'light'")  # what the page says comes first
    view.rest()
    assert differing(light, view.picture(CANVAS)) < 0.001


def test_a_browser_without_webgl_is_told(page):
    with Browser(*WITHOUT_WEBGL) as browser:
        browser.open(page)
        assert browser.run("return document.querySelector('.morphoskel-viewer').dataset.state") == "failed"
        message = browser.run("return document.querySelector('.mv-message').textContent")
        assert message.startswith("This browser offers no WebGL")
        assert browser.run("return getComputedStyle(document.querySelector('.mv-panel')).visibility") == "hidden"
