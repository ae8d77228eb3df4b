"""Keep the counts of the last recorded runs, and write docs/fuzzing.md from them."""

from __future__ import annotations

import json
from collections import Counter
from datetime import UTC, datetime
from typing import Any

from fuzz.guarded import Result
from fuzz.readers import READERS
from fuzz.regressions import REGRESSIONS
from fuzz.shape_seeds import REPOSITORY
from morphoskel.atomic import atomic_file

COUNTS = REPOSITORY / "tests" / "fuzz" / "recorded.json"
PAGE = REPOSITORY / "docs" / "fuzzing.md"

INTRODUCTION = """\
# Fuzzing of the readers

<!-- Written by `make fuzz ARGS=--record` from tests/fuzz/recorded.json and tests/fuzz/regressions.py. -->

Every reader of files, and the configuration, is fed damaged files: bits flipped, pieces cut out, repeated and taken
from other files, numbers replaced by ones that are too large, negative or no numbers, lines exchanged, encodings and
line ends changed; headers of arrays declare other types and shapes, members of archives are damaged behind checksums
that stay right. The whole files at the start are written by the project and the libraries that it uses, from small
shapes; where extracts of the real data sets are at hand, the beginnings of some of them are added. Inputs that reach
new lines of our code are kept and damaged further.

A reader must return something, or raise an error of the project that names the file. Anything else is a finding:
another error or a warning, a message without the file's name, more than 2 seconds of processor time or 256 MB of
memory for a file of at most 64 kB, room asked for that is not there (a header that declares 10^12 points), a crash, a
hang. The readers run in a process of their own under limits of the kernel, so that the last two are found and told
apart, too.

```bash
make fuzz                                          # 10,000 inputs for each of all readers
make fuzz ARGS="ply npz --count 100000 --seed 1"   # more, for some; faulty inputs go to fuzz-findings/
make fuzz ARGS="ply --count 100000 --record"       # and put the counts into this page
```

`make test` feeds 100 inputs to each reader (20 where one takes long), without following lines, and every input that was
handled wrongly once (`tests/fuzz/regressions.py`). The tests of the formats write random shapes and read them back.

## Last recorded runs

*read*: the damage did not matter, or gave another legal file. *steps*: from one line of our code to the next that some
input took. *findings*: different faults of that run, of which one may have met many inputs. *mended*: faults that
fuzzing found, or that were found by looking for the like elsewhere, each with a regression test; those of the recorded
run stay among its findings. The seed and the files that a reader starts with decide the inputs.
"""


def record(result: Result) -> None:
    """Replace the counts of a reader, and write the page anew."""
    recorded: dict[str, Any] = json.loads(COUNTS.read_text(encoding="utf-8")) if COUNTS.is_file() else {}
    recorded[result.reader] = {
        "date": datetime.now(UTC).date().isoformat(),
        "seed": result.seed,
        "inputs": result.inputs,
        "read": result.read,
        "refused": result.refused,
        "steps": result.steps,
        "seconds": round(result.seconds),
        "findings": sorted(f"{finding.kind}: {finding.where}" for finding in result.findings),
    }
    ordered = {name: recorded[name] for name in READERS if name in recorded}
    with atomic_file(COUNTS) as partial:
        partial.write_text(json.dumps(ordered, indent=1) + "\n", encoding="utf-8")
    with atomic_file(PAGE) as partial:
        partial.write_text(render(ordered), encoding="utf-8")


def render(recorded: dict[str, Any]) -> str:
    """Return the page."""
    mended = Counter(regression.reader for regression in REGRESSIONS)
    rows = ["| reader | tests | seed | inputs | read | refused | findings | steps | mended |",
            "|:--|:--|--:|--:|--:|--:|--:|--:|--:|"]  # fmt: skip
    for name, reader in READERS.items():
        if name in recorded:
            one = recorded[name]
            counts = (one["inputs"], one["read"], one["refused"], len(one["findings"]), one["steps"], mended[name])
            cells = [name, f"`{reader.function.replace(':', '.')}`", one["seed"], *(f"{count:,}" for count in counts)]
        else:
            cells = [name, f"`{reader.function.replace(':', '.')}`", "", *["not run"] * 5, f"{mended[name]:,}"]
        rows.append(f"| {' | '.join(map(str, cells))} |")
    known = {(regression.reader, regression.finding) for regression in REGRESSIONS}
    left = [
        f"- {name}: {finding}"
        for name, one in recorded.items()
        for finding in one["findings"]
        if (name, finding) not in known
    ]
    found = [
        f"- {name}: {', '.join(r.what for r in REGRESSIONS if r.reader == name)}" for name in READERS if mended[name]
    ]
    parts = [INTRODUCTION, "\n".join(rows), "## Mended", "\n".join(found)]
    if left:
        parts += ["## Not mended yet", "\n".join(left)]
    return "\n\n".join(part.rstrip("\n") for part in parts) + "\n"
