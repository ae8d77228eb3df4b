"""``morphoskel export``: a skeleton, and the surface around it, for other programs."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path

from morphoskel.commands.subcommand import Subcommands, add_subcommand, named_files
from morphoskel.errors import InputError

logger = logging.getLogger("morphoskel")

EXAMPLES = """\
examples:
  morphoskel export out/dragon.ply -o dragon.glb               balls coloured by radius, for any viewer of glTF
  morphoskel export out/dragon.ply dragon_mesh.ply -o dragon.glb   inside the translucent surface
  morphoskel export out/dragon.npz -o dragon.obj --subdivisions 3  rounder balls
  morphoskel export medial_axis.ma -o medial_axis.npz          the numbers alone, for NumPy

what SKELETON may be: PLY with the property radius, NPZ with points and radii, MA
what is written:
  .glb   named nodes: balls, sheets, curves, surface; opens in Blender, PowerPoint, Windows and viewers on the web
  .obj   the same as objects, with colours at vertices; the surface is opaque, hide it to see the balls
  .ply   all in one mesh, with colours and opacity at vertices; many viewers ignore the opacity and hide the balls
  .npz   the arrays points, radii, residues, edges, triangles, surface_vertices, surface_triangles, unchanged
Balls are dark blue at radius 0 and yellow at the largest (viridis).
"""


def add_export(commands: Subcommands) -> None:
    """Add the subcommand."""
    export = add_subcommand(commands, "export", "write a skeleton as PLY, OBJ, GLB or NPZ for other programs", EXAMPLES)
    export.usage = "morphoskel export SKELETON [MESH] -o FILE [--subdivisions N]"
    export.add_argument("words", nargs="+", metavar="SKELETON [MESH]",
                        help="a skeleton, and if wanted the surface around it")  # fmt: skip
    export.add_argument("-o", "--output", type=Path, required=True, metavar="FILE",
                        help="file to write: .ply, .obj, .glb or .npz")  # fmt: skip
    export.add_argument("--subdivisions", type=int, metavar="N",
                        help="of the balls: 20 * 4^N triangles each, N from 0 to 5 (default: the most up to 4 with at "
                             "most 500,000 triangles in all)")  # fmt: skip


def run_export(parsed: argparse.Namespace) -> int:
    """Run the subcommand and return its exit code."""
    from morphoskel.exporting.export import check_export_suffix, export_skeleton
    from morphoskel.formats.read_mesh import read_mesh
    from morphoskel.formats.skeleton_file import read_skeleton

    files = named_files(parsed.words, "SKELETON and perhaps MESH", least=1, most=2)
    output: Path = parsed.output
    suffix = check_export_suffix(output)
    if suffix == ".npz" and parsed.subdivisions is not None:
        raise InputError("an NPZ file holds no meshes of balls; leave --subdivisions out")
    for file in files:
        if file.resolve() == output.resolve():
            raise InputError(f"{output} is read and would be overwritten; write to another file")
    skeleton = read_skeleton(files[0])
    surface = read_mesh(files[1]) if len(files) == 2 else None
    export_skeleton(output, skeleton, surface, subdivisions=parsed.subdivisions)
    logger.info("%s: %r", files[0], skeleton)
    logger.info("wrote %s (%.1f MB)", output, output.stat().st_size / 1e6)
    return 0
