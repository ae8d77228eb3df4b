"""The command behind `make fuzz`."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

from fuzz.guarded import Result, fuzz_reader
from fuzz.readers import READERS
from fuzz.record import record


def main() -> int:
    """Fuzz the readers that are named, and return 1 if one of them did wrong."""
    parser = argparse.ArgumentParser("make fuzz", description=__doc__)
    parser.add_argument("readers", nargs="*", metavar="READER", help=f"among {', '.join(READERS)}; default: all")
    parser.add_argument("--count", type=int, default=10_000, help="inputs a reader (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=0, help="seed of all randomness (default: %(default)s)")
    parser.add_argument("--findings", type=Path, default=Path("fuzz-findings"), help="where to write faulty inputs")
    parser.add_argument("--record", action="store_true", help="put the counts into docs/fuzzing.md")
    parsed = parser.parse_args()
    unknown = [name for name in parsed.readers if name not in READERS]
    if unknown:
        parser.error(f"no such reader: {', '.join(unknown)}")
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    found = 0
    for name in parsed.readers or READERS:
        result = fuzz_reader(name, count=parsed.count, seed=parsed.seed)
        _report(result, parsed.findings)
        found += len(result.findings)
        if parsed.record:
            record(result)
    return 1 if found else 0


def _report(result: Result, folder: Path) -> None:
    sys.stdout.write(
        f"{result.reader}: {result.inputs:,} inputs in {result.seconds:.0f} s, {result.read:,} read, "
        f"{result.refused:,} refused, {result.steps} steps from {result.kept} files, {len(result.findings)} findings\n"
    )
    for number, finding in enumerate(result.findings):
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{result.reader}-{number}"
        path.write_bytes(finding.content)
        sys.stdout.write(f"  {finding.kind}: {finding.where}: {path} ({finding.content[:100]!r})\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
