"""The command ``morphoskel``."""

from __future__ import annotations

import argparse
import logging
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from morphoskel import __version__
from morphoskel.commands.compare_command import add_compare, run_compare
from morphoskel.commands.export_command import add_export, run_export
from morphoskel.commands.plan_command import add_plan, run_plan
from morphoskel.commands.subcommand import Subcommands, add_subcommand
from morphoskel.commands.view_command import add_view, run_view
from morphoskel.errors import MorphoSkelError
from morphoskel.logs import BesideBars
from morphoskel.methods import METHODS
from morphoskel.sampling.samplers import SAMPLERS

if TYPE_CHECKING:
    from morphoskel.batch import BatchResult

logger = logging.getLogger("morphoskel")

DESCRIPTION = "Morphological skeletons of 3D shapes, and the experiments of MorphoSkel3D."

RUN_EXAMPLES = """\
examples:
  morphoskel run                                          every table, on the embedded data set
  morphoskel run table_processing_time                    one table
  morphoskel run skeleton.k=30 seed=7                     other values
  morphoskel run dataset=point2skeleton dataset.root=/data/p2s run=p2s   real clouds, into results/p2s
  morphoskel run experiment=paper -- --dry-run            what would be done; after -- come Snakemake's options
"""

SKELETONIZE_EXAMPLES = """\
examples:
  morphoskel skeletonize dragon.ply -o out --plot
  morphoskel skeletonize clouds/ -o out skeleton.points=200 skeleton.candidates.count=10000000
the paper's method, and other surfaces for it:
  morphoskel skeletonize clouds/ -o out --method ms3d --surface poisson
  morphoskel skeletonize clouds/ -o out --method ms3d --surface alpha_shape skeleton.k=30
other methods, and one setting of each:
  morphoskel skeletonize clouds/ -o out --method coverage_axis methods.coverage_axis.points=100
  morphoskel skeletonize clouds/ -o out --method l1_medial methods.l1_medial.samples=500
  morphoskel skeletonize clouds/ -o out --method dpc methods.dpc.samples=1000
  morphoskel skeletonize clouds/ -o out --method point2skeleton --network network.pt

methods inside a closed surface, which --surface rebuilds from a cloud:
  ms3d_coverage   maximal balls that together explain the surface (our own selection)
  ms3d            maximal balls of smallest residue: the paper's, with --surface poisson
  coverage_axis   Coverage Axis++
methods on the cloud alone:
  l1_medial       L1-medial skeleton: curves
  dpc             deep points consolidation
  point2skeleton  a network, trained with: morphoskel run train_point2skeleton dataset=NAME run=RUN
                  it is written to results/RUN/networks/NAME/point2skeleton/network.pt
surfaces: poisson, ball_pivoting, alpha_shape, ponq, repaired_poisson (mended where it contradicts the cloud)

`morphoskel config` prints all settings.
"""

SAMPLE_EXAMPLES = """\
examples:
  morphoskel sample dragon.ply -o out --sampler lfs --points 128 --plot
  morphoskel sample clouds/ -o out --sampler lfs --surface poisson samplers.lfs.exponent=0.5
  morphoskel sample clouds/ -o out --sampler random --points 64 seed=7
  morphoskel sample clouds/ -o out --sampler samplenet --network network.pt
  morphoskel sample clouds/ -o out --sampler ms3d --network network.pt --noise

samplers without training:
  random          points drawn at random
  fps             farthest points, starting with the first
  lfs             farthest points, distances divided by the local feature size: more points in thin parts
samplers with a network, which knows how many points it chooses:
  snet, samplenet, metasampler
                  generate points, each of which is replaced by the nearest of the cloud
  skeleton_aware  skeleton-aware sampling; its skeletons come from --skeleton-network
  ms3d, dpc, l1_medial
                  the same, guided by the skeleton of that method
  uniform, shuffled
                  the same without a skeleton, and with weights in random order, for comparison
Give the settings sampling.skeleton and sampling.surface that it was trained with; its file knows the others.

Each input gives NAME.ply, the chosen points, and NAME.npz with their indices and, if it was measured, the local feature
size of all points and the skeleton. Of a mesh, points are chosen among 2000 that are drawn on it.
"""

CONFIG_EXAMPLES = """\
examples:
  morphoskel config
  morphoskel config experiment=paper dataset.root=/data/p2s
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code: 0 done, 1 something failed, 2 wrong usage."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    words, options = _split(words)
    parsed, later = _parser().parse_known_args(words)
    unknown = [word for word in later if word.startswith("-")]
    if unknown:
        _parser().error(f"unrecognized arguments: {' '.join(unknown)}")
    parsed.words += later  # argparse gives up on positional words that come after an option
    if options and parsed.command != "run":
        _parser().error("options after -- are for `morphoskel run` only")
    logging.basicConfig(level=logging.INFO, format="%(message)s", handlers=[BesideBars(sys.stderr)], force=True)
    try:
        if parsed.command == "run":
            return _run(parsed, options)
        actions = {"skeletonize": _skeletonize, "sample": _sample, "export": run_export, "compare": run_compare,
                   "plan": run_plan, "view": run_view, "config": _show_config}  # fmt: skip
        return actions[parsed.command](parsed)
    except MorphoSkelError as error:
        logger.error("morphoskel: %s", error)
        return 1


def _split(words: list[str]) -> tuple[list[str], list[str]]:
    """Split at the first ``--``."""
    if "--" not in words:
        return words, []
    at = words.index("--")
    return words[:at], words[at + 1 :]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("morphoskel", description=DESCRIPTION)
    parser.add_argument("--version", action="version", version=f"morphoskel {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    run = add_subcommand(commands, "run", "build tables, figures or any other target of the workflow", RUN_EXAMPLES)
    run.add_argument("words", nargs="*", metavar="TARGET | key=value", help="rules, files, and overrides, in any order")
    one = add_subcommand(commands, "skeletonize",
                         "skeletonize shapes of your own: PLY, PCD, OBJ, OFF, STL, XYZ, TXT, NPY, NPZ",
                         SKELETONIZE_EXAMPLES)  # fmt: skip
    one.add_argument("words", nargs="+", metavar="INPUT | key=value", help="files or folders, and overrides")
    one.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="folder to write to")
    one.add_argument("--method", default="ms3d_coverage", choices=METHODS, metavar="NAME",
                     help="the skeleton method (default: %(default)s; the paper's: ms3d)")  # fmt: skip
    one.add_argument("--surface", default="repaired_poisson", metavar="NAME",
                     help="how a cloud's surface is rebuilt (default: %(default)s; the paper's: poisson)")  # fmt: skip
    one.add_argument("--network", type=Path, metavar="PATH", help="file with a trained network, for point2skeleton")
    one.add_argument("--plot", action="store_true", help="also draw the balls, inside the surface if any, as PNG")
    _add_sample(commands)
    for add in (add_export, add_compare, add_view, add_plan):
        add(commands)
    config = add_subcommand(commands, "config", "print the configuration that the overrides give", CONFIG_EXAMPLES)
    config.add_argument("words", nargs="*", metavar="key=value", help="overrides")
    return parser


def _add_sample(commands: Subcommands) -> None:
    sample = add_subcommand(commands, "sample",
                            "choose points of shapes of your own, for example more of them in thin parts",
                            SAMPLE_EXAMPLES)  # fmt: skip
    sample.add_argument("words", nargs="+", metavar="INPUT | key=value", help="files or folders, and overrides")
    sample.add_argument("-o", "--output", type=Path, required=True, metavar="DIR", help="folder to write to")
    sample.add_argument("--sampler", default="lfs", choices=SAMPLERS, metavar="NAME",
                        help="the sampler (default: %(default)s)")  # fmt: skip
    sample.add_argument("--points", type=int, metavar="N",
                        help="points to choose (default: 128, or as many as the network was trained to)")  # fmt: skip
    sample.add_argument("--surface", metavar="NAME",
                        help="how a cloud is closed to find its skeleton (default: sampling.surface)")  # fmt: skip
    sample.add_argument("--network", type=Path, metavar="PATH", help="file with the sampler's trained network")
    sample.add_argument("--skeleton-network", type=Path, metavar="PATH",
                        help="file with the network that predicts skeletons, for skeleton_aware")  # fmt: skip
    sample.add_argument("--noise", action="store_true",
                        help="let the network draw points instead of taking the most probable ones")  # fmt: skip
    sample.add_argument("--plot", action="store_true", help="also draw the chosen points in their cloud, as PNG")


def _is_override(word: str) -> bool:
    """Tell an override (``key=value``, or ``~key`` to leave something out) from a file or target."""
    return ("=" in word or re.fullmatch(r"~[a-z_.]+", word) is not None) and not Path(word).exists()


def _run(parsed: argparse.Namespace, options: list[str]) -> int:
    from morphoskel.workflow_run import run_workflow

    targets = [word for word in parsed.words if not _is_override(word)]
    overrides = [word for word in parsed.words if _is_override(word)]
    return run_workflow(targets, overrides, options)


def _skeletonize(parsed: argparse.Namespace) -> int:
    from morphoskel.batch import skeletonize_files
    from morphoskel.config import compose

    config = compose([word for word in parsed.words if _is_override(word)])
    inputs = [Path(word) for word in parsed.words if not _is_override(word)]
    result = skeletonize_files(
        inputs,
        parsed.output,
        config,
        method=parsed.method,
        surface=parsed.surface,
        network=parsed.network,
        plot=parsed.plot,
    )
    return _report(result)


def _sample(parsed: argparse.Namespace) -> int:
    from morphoskel.config import compose
    from morphoskel.sampling.sample_files import SamplingRequest, sample_files

    config = compose([word for word in parsed.words if _is_override(word)])
    inputs = [Path(word) for word in parsed.words if not _is_override(word)]
    request = SamplingRequest(
        parsed.sampler,
        points=parsed.points,
        surface=parsed.surface,
        network=parsed.network,
        skeleton_network=parsed.skeleton_network,
        noise=parsed.noise,
        plot=parsed.plot,
    )
    return _report(sample_files(inputs, parsed.output, config, request))


def _report(result: BatchResult) -> int:
    for path in result.written:
        logger.info("wrote %s", path)
    for path, reason in result.failures.items():
        logger.error("%s: FAILED: %s", path, reason)
    return 1 if result.failures else 0


def _show_config(parsed: argparse.Namespace) -> int:
    import yaml

    from morphoskel.config import compose

    values = compose(parsed.words).model_dump(mode="json")
    sys.stdout.write(yaml.safe_dump(values, sort_keys=False))
    return 0


if __name__ == "__main__":
    sys.exit(main())
