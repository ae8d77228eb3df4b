"""Run benchmarks by name, all by default: ``python -m benchmarks [NAME]...`` with the names below."""

import importlib
import logging
import sys
from pathlib import Path

NAMES = ("ms3d", "scaling", "workflow", "held_out", "training_step", "determinism")
FOLDER = Path(__file__).resolve().parents[1] / "results" / "bench"


def main(arguments: list[str]) -> int:
    """Run the named benchmarks, say where their results are, and return 1 if a check of one failed."""
    unknown = set(arguments) - set(NAMES)
    if unknown:
        sys.exit(f"{', '.join(sorted(unknown))}: no such benchmark; there are {', '.join(NAMES)}")
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    FOLDER.mkdir(parents=True, exist_ok=True)
    failed = [name for name in arguments or NAMES if not importlib.import_module(f"benchmarks.{name}").run(FOLDER)]
    for path in sorted(FOLDER.glob("*.*")):
        logging.info("%s", path)
    for name in failed:
        logging.error("%s: its check failed, see its results", name)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
