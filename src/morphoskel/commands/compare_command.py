"""``morphoskel compare``: distances between a skeleton and a surface, or between two skeletons."""

from __future__ import annotations

import argparse
import json
import sys
from typing import TYPE_CHECKING, Any

from morphoskel.commands.subcommand import Subcommands, add_subcommand, named_files
from morphoskel.errors import InputError

if TYPE_CHECKING:
    from morphoskel.evaluation.compare import Comparison
    from morphoskel.shapes import Mesh, PointCloud, Skeleton

EXAMPLES = """\
examples:
  morphoskel compare out/dragon.ply dragon.ply          balls with the cloud: CD-Recon and HD-Recon, as in the tables
  morphoskel compare out/dragon.ply mesh.obj --samples 20000   with points drawn on a mesh
  morphoskel compare out/dragon.ply other/dragon.npz    centres with centres: CD and HD
  morphoskel compare out/dragon.ply axis_mat.ply --centres     with a medial axis whose file has no radii
  morphoskel compare out/dragon.ply dragon.ply --json   the same numbers for a script

what A may be: PLY with the property radius, NPZ with points and radii, MA
CD is the sum of both means, HD the larger of both maxima; distances are not squared, and in the shapes' unit.
Nothing is scaled: to compare with the published tables the shapes must be normalised as their data set is.
"""


def add_compare(commands: Subcommands) -> None:
    """Add the subcommand."""
    compare = add_subcommand(commands, "compare", "measure how far a skeleton is from a shape or another skeleton",
                             EXAMPLES)  # fmt: skip
    compare.usage = "morphoskel compare A B [--centres] [--samples N] [--seed N] [--protocol NAME] [--json]"
    compare.add_argument("words", nargs="+", metavar="A B", help="a skeleton; a skeleton, a cloud or a mesh")
    compare.add_argument("--centres", action="store_true", help="compare centres although B is a cloud")
    compare.add_argument("--samples", type=int, metavar="N", help="points drawn on a mesh (default: 100000)")
    compare.add_argument("--seed", type=int, default=0, metavar="N", help="to draw them from (default: %(default)s)")
    compare.add_argument("--protocol", default="correct", choices=("correct", "released"),
                         help="divide the second mean by the number of balls, or, like the evaluation released with "
                              "the paper, by the number of surface points (default: %(default)s)")  # fmt: skip
    compare.add_argument("--json", action="store_true", help="print JSON instead of a table")


def run_compare(parsed: argparse.Namespace) -> int:
    """Run the subcommand and return its exit code."""
    from morphoskel.evaluation.compare import SURFACE_POINTS, compare_skeleton
    from morphoskel.formats.skeleton_file import WHAT_HOLDS_A_SKELETON, read_skeleton_or_shape
    from morphoskel.shapes import Mesh, Skeleton

    files = named_files(parsed.words, "A and B", least=2, most=2)
    skeleton, other = map(read_skeleton_or_shape, files)
    if not isinstance(skeleton, Skeleton):
        swap = "; name the skeleton first" if isinstance(other, Skeleton) else ""
        raise InputError(f"{files[0]}: A must be a skeleton ({WHAT_HOLDS_A_SKELETON}), found {skeleton!r}{swap}")
    if parsed.samples is not None and not isinstance(other, Mesh):
        raise InputError(f"{files[1]}: points are drawn on a mesh only, found {other!r}; leave --samples out")
    samples = SURFACE_POINTS if parsed.samples is None else parsed.samples
    try:
        comparison = compare_skeleton(
            skeleton, other, centres=parsed.centres, protocol=parsed.protocol, samples=samples, seed=parsed.seed
        )
    except InputError as error:
        raise InputError(f"{files[1]}: {error}") from error
    described = [_describe(skeleton), _describe(other, samples, parsed.seed)]
    if parsed.json:
        sys.stdout.write(json.dumps(_values(comparison, parsed.words, described), indent=2) + "\n")
    else:
        sys.stdout.write(_table(comparison, parsed.words, described))
    return 0


def _describe(shape: Skeleton | PointCloud | Mesh, samples: int = 0, seed: int = 0) -> str:
    from morphoskel.shapes import Mesh, Skeleton

    if isinstance(shape, Mesh):
        return f"{samples:,} points drawn on {len(shape.triangles):,} triangles, seed {seed}"
    return f"{len(shape):,} {'balls' if isinstance(shape, Skeleton) else 'points'}"


def _values(comparison: Comparison, names: list[str], described: list[str]) -> dict[str, Any]:
    """Return everything that was measured, for a script."""
    to_a, to_b = comparison.other_to_skeleton, comparison.skeleton_to_other
    return {
        "a": {"file": names[0], "what": described[0]},
        "b": {"file": names[1], "what": described[1]},
        "compared": "balls with surface" if comparison.of_surface else "centres with centres",
        "protocol": comparison.protocol,
        "cd": comparison.chamfer,
        "hd": comparison.hausdorff,
        "b_to_a": {"mean": to_a[0], "max": to_a[1], "count": comparison.distances.surface_points},
        "a_to_b": {"mean": to_b[0], "max": to_b[1], "count": comparison.distances.spheres},
    }


def _table(comparison: Comparison, names: list[str], described: list[str]) -> str:
    """Return the files, and the distances in aligned columns."""
    suffix = "-Recon" if comparison.of_surface else ""
    kinds = ("surface to balls", "balls to surface") if comparison.of_surface else ("centres B to A", "centres A to B")
    rows = [
        ("", "mean", "largest"),
        *((kind, *map(_number, pair)) for kind, pair in zip(
            kinds, (comparison.other_to_skeleton, comparison.skeleton_to_other), strict=True)),
        (f"CD{suffix}", _number(comparison.chamfer), ""),
        (f"HD{suffix}", "", _number(comparison.hausdorff)),
    ]  # fmt: skip
    width = max(map(len, names))
    lines = [f"{letter}  {name:<{width}}  {what}" for letter, name, what in zip("AB", names, described, strict=True)]
    lines += ["", *(f"{first:<16}  {mean:>10}  {largest:>10}".rstrip() for first, mean, largest in rows)]
    if comparison.protocol == "released":
        lines += ["", "protocol released: the second mean is divided by the number of points of B"]
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    return f"{value:.6g}"
