"""Run the load test, or go on with one that was stopped."""

import argparse
import logging
import signal
import sys
from pathlib import Path

from tests.load.check import summarise
from tests.load.clouds import COUNTS
from tests.load.record import record, render
from tests.load.run import REPOSITORY, Load, prepare, run_to_end


def main():
    """Return 0 if every demand was met."""
    parser = argparse.ArgumentParser("python -m tests.load", description=__doc__)
    parser.add_argument("--shapes", type=int, default=sum(COUNTS.values()), help="(default: %(default)s)")
    parser.add_argument("--shard-size", type=int, default=256, help="shapes a job (default: %(default)s)")
    parser.add_argument("--folder", type=Path, default=REPOSITORY / "results" / "load",
                        help="where everything is written to; delete it to begin anew")  # fmt: skip
    parser.add_argument("--record", action="store_true", help="write the numbers of a finished test into docs/load.md")
    parsed = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s", datefmt="%H:%M:%S")
    load = Load(parsed.folder.resolve(), parsed.shapes, parsed.shard_size)
    if parsed.record:
        record(load, REPOSITORY / "results" / "reference" / "load", REPOSITORY / "docs" / "load.md")
        return 0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the run does not outlive this process
    signal.signal(signal.SIGINT, signal.default_int_handler)  # background jobs of a shell ignore it
    load.folder.mkdir(parents=True, exist_ok=True)
    prepare(load)
    summary = summarise(load, run_to_end(load))
    logging.info("%s", render(summary))
    return 1 if summary["missed"] else 0


if __name__ == "__main__":
    sys.exit(main())
