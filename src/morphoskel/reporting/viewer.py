"""An interactive view of scenes as HTML that needs nothing from the network."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from importlib.resources import files

from morphoskel.errors import InputError
from morphoskel.reporting.scene import Scene
from morphoskel.reporting.scene_encoding import encode_scenes

ASSETS = "morphoskel.reporting", "assets"

MISSING_SCRIPT = "This 3D view needs JavaScript and WebGL, and is still waiting for them."

HINT = (
    "Drag to rotate; right drag, Shift and drag, or two fingers to move; wheel (after a click) or pinch to zoom. "
    "Keys: arrows, + and −, R to reset."
)


def viewer_html(scenes: Sequence[Scene], *, label: str = "3D view", with_assets: bool = True) -> str:
    """Return an element ``section`` that shows the scenes, to stand in any page.

    Parameters
    ----------
    scenes
        At least one, with names of their own.
    label
        What is seen, for readers who do not see it.
    with_assets
        Begin with the style and end with the script (0.5 MB). A page with several views needs them once: with the
        first.

    Returns
    -------
    str
        HTML without any reference to another file. It follows the reader's preference for light or dark colours, and
        the page's if that has ``data-theme="light"`` or ``"dark"`` on its root.

    Raises
    ------
    InputError
        If there is no scene, or two have the same name.
    """
    names = [scene.name for scene in scenes]
    if not names:
        raise InputError("a view needs at least one scene, got none")
    if len(set(names)) < len(names):
        raise InputError(f"scenes need names of their own, got {', '.join(names)}")
    style = f"<style>{_asset('viewer.css')}</style>\n" if with_assets else ""
    script = f"\n<script>{_asset('viewer.min.js')}</script>" if with_assets else ""
    return f"""{style}<section class="morphoskel-viewer" aria-label="{escape(label)}">
<div class="mv-view">
<div class="mv-stage">
<canvas class="mv-canvas" tabindex="0" role="application" aria-label="{escape(label)}"></canvas>
<p class="mv-message" role="status">{MISSING_SCRIPT}</p>
</div>
<div class="mv-bars"></div>
</div>
<div class="mv-panel">
<label class="mv-scene">Shape <select></select></label>
<fieldset class="mv-layers"><legend>Layers</legend></fieldset>
<button type="button" class="mv-reset">Reset view</button>
<p class="mv-hint">{HINT}</p>
</div>
<script type="application/json" class="mv-data">{encode_scenes(scenes)}</script>
</section>{script}"""


def viewer_page(scenes: Sequence[Scene], title: str) -> str:
    """Return a whole HTML page that shows the scenes and fills the window.

    Parameters
    ----------
    scenes
        At least one, with names of their own.
    title
        Of the page.

    Raises
    ------
    InputError
        If there is no scene, or two have the same name.
    """
    return f"""<!DOCTYPE html>
<html lang="en" class="mv-page">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="MorphoSkel">
<link rel="icon" href="data:,">
<title>{escape(title)}</title>
</head>
<body>
<h1>{escape(title)}</h1>
{viewer_html(scenes, label=title)}
</body>
</html>
"""


def _asset(name: str) -> str:
    package, folder = ASSETS
    return files(package).joinpath(folder, name).read_text(encoding="utf-8").strip()
