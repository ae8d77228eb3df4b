"""``morphoskel view``: an interactive page of skeletons, clouds and meshes."""

from __future__ import annotations

import argparse
import logging
import os
import sys
from pathlib import Path

from morphoskel.commands.subcommand import Subcommands, add_subcommand, named_files
from morphoskel.errors import InputError

logger = logging.getLogger("morphoskel")

EXAMPLES = """\
examples:
  morphoskel view out/dragon.ply                               the balls of a skeleton
  morphoskel view out/dragon.npz dragon.ply -o dragon.html     with the cloud or mesh that it was made from
  morphoskel view ms3d/*.npz dpc/*.npz --no-open -o both.html  two methods on many shapes, to be switched between
  morphoskel view chosen/dragon.npz dragon.ply                 points that `morphoskel sample` chose, and their cloud
  morphoskel view a.ply b.obj --together                       files of different names, one over the other

The page is one file that needs no network and may be sent to others. Files of the same name, whatever their folder and
suffix, are shown together; readers choose among names.
"""


def add_view(commands: Subcommands) -> None:
    """Add the subcommand."""
    view = add_subcommand(commands, "view", "show skeletons, clouds and meshes in the browser, to be turned and zoomed",
                          EXAMPLES)  # fmt: skip
    view.add_argument("words", nargs="+", metavar="FILE",
                      help="skeletons, clouds, meshes, and .npz files of `morphoskel sample`")  # fmt: skip
    view.add_argument("-o", "--output", type=Path, metavar="PAGE",
                      help="page to write (default: the first file's name with .html, in this folder)")  # fmt: skip
    view.add_argument("--no-open", action="store_true", help="write the page, but do not open it")
    view.add_argument("--together", action="store_true", help="show all files at once, whatever their names")
    view.add_argument("--up", default="y", choices=("y", "z"), help="the axis that points up (default: %(default)s)")
    view.add_argument("--azimuth", type=float, default=35.0, metavar="DEGREES",
                      help="from where the shapes are seen at first, around the vertical axis (default: %(default)g; "
                           "the published clouds show their front at 235)")  # fmt: skip
    view.add_argument("--title", help="of the page (default: the names of the shapes)")


def run_view(parsed: argparse.Namespace) -> int:
    """Run the subcommand and return its exit code."""
    from morphoskel.atomic import atomic_file
    from morphoskel.reporting.scene_files import scenes_of_files
    from morphoskel.reporting.viewer import viewer_page

    files = named_files(parsed.words, "FILE", least=1, most=sys.maxsize)
    given: Path | None = parsed.output
    if given is not None and given.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"{given}: the page needs the suffix .html for a browser to show it; rename the output")
    scenes = scenes_of_files(files, together=parsed.together, up=parsed.up, azimuth=parsed.azimuth)
    names = [scene.name for scene in scenes]
    output = given or Path(f"{names[0]}.html")
    title = parsed.title or ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
    with atomic_file(output) as partial:
        partial.write_text(viewer_page(scenes, title), encoding="utf-8")
    logger.info("wrote %s (%.1f MB)", output, output.stat().st_size / 1e6)
    if not parsed.no_open and not _open(output):
        logger.info("no browser found; open the page yourself")
    return 0


def _open(page: Path) -> bool:
    """Show the page in the user's browser; on a Linux without a display there is none but those of the terminal."""
    import webbrowser

    without_display = sys.platform == "linux" and not {"DISPLAY", "WAYLAND_DISPLAY", "BROWSER"} & os.environ.keys()
    return not without_display and webbrowser.open(page.resolve().as_uri())
