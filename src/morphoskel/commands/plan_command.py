"""``morphoskel plan``: what an experiment will cost."""

from __future__ import annotations

import argparse
import json
import logging
import sys
from pathlib import Path

from morphoskel.commands.subcommand import Subcommands, add_subcommand
from morphoskel.errors import InputError

logger = logging.getLogger("morphoskel")

EXAMPLES = """\
examples:
  morphoskel plan experiment=paper                       from the newest finished run, or the measurements that we made
  morphoskel plan experiment=paper table_surface_reconstruction --measured results/demo
  morphoskel plan skeletons dataset=modelnet40 surface=[poisson] --at-once 1 --at-once 100
  morphoskel plan experiment=paper --json                the same for a script
  morphoskel plan --measured results/demo --save times.csv     keep measurements without their run

Nothing is run, and the data sets need not be there. A rule without a measurement under the same settings says so and is
in no sum.
"""


def add_plan(commands: Subcommands) -> None:
    """Add the subcommand."""
    plan = add_subcommand(commands, "plan", "tell jobs, core-hours, disk and wall time of an experiment", EXAMPLES)
    plan.add_argument("words", nargs="*", metavar="TARGET | key=value", help="as of `morphoskel run`")
    plan.add_argument("--measured", type=Path, action="append", default=[], metavar="RUN",
                      help="a finished run, or a file of --save; of several, the first that fits counts")  # fmt: skip
    plan.add_argument("--at-once", type=int, action="append", default=[], metavar="N",
                      help="jobs at a time, for the wall time; may be repeated (default: 1, 8, 64)")  # fmt: skip
    plan.add_argument("--cores", type=int, metavar="N",
                      help="of each machine (default: as many as the largest job asks for)")  # fmt: skip
    plan.add_argument("--json", action="store_true", help="print JSON instead of a table")
    plan.add_argument(
        "--save", type=Path, metavar="FILE", help="write the measurements to a CSV file, and plan nothing"
    )


def run_plan(parsed: argparse.Namespace) -> int:
    """Run the subcommand and return its exit code."""
    from morphoskel.planning.measurements import write_measurements
    from morphoskel.planning.plan import default_measurements, plan_experiment, read_source
    from morphoskel.planning.plan_table import render_plan
    from morphoskel.workflow_run import find_repository

    if any(number is not None and number < 1 for number in (parsed.cores, *parsed.at_once)):
        raise InputError("--cores and --at-once must be at least 1")
    repository = find_repository(Path.cwd())
    sources = parsed.measured or [default_measurements(repository)]
    if parsed.save:
        write_measurements(parsed.save, [each for source in sources for each in read_source(source)])
        logger.info("wrote %s", parsed.save)
        return 0
    is_override = [("=" in word and not Path(word).exists()) for word in parsed.words]
    values = plan_experiment(
        repository,
        [word for word, override in zip(parsed.words, is_override, strict=True) if not override],
        [word for word, override in zip(parsed.words, is_override, strict=True) if override],
        measured=sources,
        at_once=parsed.at_once or (1, 8, 64),
        cores=parsed.cores,
    )
    sys.stdout.write((json.dumps(values, indent=2) if parsed.json else render_plan(values)) + "\n")
    return 0
