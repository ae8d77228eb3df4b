"""A headless Chromium, driven through chromedriver by the W3C WebDriver protocol."""

import base64
import io
import json
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request

import numpy as np
from PIL import Image

FLAGS = (
    "--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--disable-dev-shm-usage",
)  # fmt: skip
SOFTWARE_WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WITHOUT_WEBGL = ("--disable-gpu", "--disable-3d-apis")

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
"""The key under which the protocol sends references to elements."""


def find_browser():
    """Return the paths of Chromium and of its driver, or None if one is absent."""
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    driver = shutil.which("chromedriver")
    return (browser, driver) if browser and driver else None


class Browser:
    """A browser with one window, to be used in a ``with`` statement."""

    def __init__(self, *flags):
        self.flags = [*FLAGS, *flags]

    def __enter__(self):
        browser, driver = find_browser()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.process = subprocess.Popen([driver, f"--port={port}"], stdout=subprocess.DEVNULL)
        self.base = f"http://127.0.0.1:{port}"
        try:
            self._wait_for(lambda: self._send("GET", "/status")["ready"], "chromedriver does not answer")
            options = {"binary": browser, "args": self.flags}
            wanted = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
            session = self._send("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
            self.base += f"/session/{session['sessionId']}"
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(self, *_):
        try:
            self._send("DELETE", "")
        finally:
            self._end()

    def _end(self):
        self.process.terminate()
        self.process.wait(timeout=30)

    def open(self, path, width=1280, height=900, *, dark=False):
        """Open a page in a window of that size, and wait until its viewer is ready or has failed."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.command("Emulation.setDeviceMetricsOverride", **metrics)
        scheme = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.command("Emulation.setEmulatedMedia", features=scheme)
        self._send("POST", "/url", {"url": path.resolve().as_uri()})
        ended = "return ['ready', 'failed'].includes(document.querySelector('.morphoskel-viewer').dataset.state)"
        self._wait_for(lambda: self.run(ended), "the viewer does not start")
        self.rest()

    def run(self, script, *arguments):
        """Run a script as the body of a function, and return what it returns."""
        return self._send("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def rest(self):
        """Wait until the page has drawn what is due."""
        script = "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()));"
        self._send("POST", "/execute/async", {"script": script, "args": []})

    def command(self, name, **parameters):
        """Send a command of the DevTools protocol."""
        return self._send("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def find(self, selector):
        """Return the only element that matches, or the first."""
        return self._send("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self._send("POST", f"/element/{self.find(selector)}/click", {})
        self.rest()

    def type(self, selector, keys):
        self._send("POST", f"/element/{self.find(selector)}/value", {"text": keys})
        self.rest()

    def drag(self, selector, across, along, *, button=0):
        """Press a mouse button in the middle of an element, move by pixels, and let go."""
        origin = {ELEMENT: self.find(selector)}
        moves = [
            {"type": "pointerMove", "origin": origin, "x": 0, "y": 0, "duration": 0},
            {"type": "pointerDown", "button": button},
            {"type": "pointerMove", "origin": "pointer", "x": across, "y": along, "duration": 50},
            {"type": "pointerUp", "button": button},
        ]
        source = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": moves}
        self._send("POST", "/actions", {"actions": [source]})
        self.rest()

    def picture(self, selector="body"):
        """Return the element as it is seen, ``(rows, columns, 3)`` uint8."""
        content = base64.b64decode(self._send("GET", f"/element/{self.find(selector)}/screenshot"))
        return np.asarray(Image.open(io.BytesIO(content)).convert("RGB"))

    def complaints(self):
        """Return what the page has written to the console since the last call."""
        return [entry["message"] for entry in self._send("POST", "/se/log", {"type": "browser"})]

    def _send(self, method, path, body=None):
        content = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, content, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {json.load(error)['value']['message']}") from error

    @staticmethod
    def _wait_for(condition, complaint, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if condition():
                    return
            except urllib.error.URLError:
                pass
            time.sleep(0.05)
        raise TimeoutError(complaint)
