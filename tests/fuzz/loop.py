"""The loop: damage a file, read it, keep it to go on from if it reached something new."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from fuzz.feedback import Steps, traced
from fuzz.judge import Finding, judge
from fuzz.mutations import mutate

LARGEST_KEPT = 8192
"""Bytes of the largest input to go on from."""


@dataclass
class Tally:
    """What became of the inputs.

    Parameters
    ----------
    outcomes
        Number of inputs that were read, refused, or handled wrongly.
    findings
        The smallest input of each, by kind and place.
    steps
        Different steps that our code took.
    kept
        Inputs that reached new ones, and the whole files at the start.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    findings: dict[tuple[str, str], Finding] = field(default_factory=dict)
    steps: int = 0
    kept: int = 0

    def add(self, outcome: str | Finding) -> None:
        """Count an outcome."""
        if isinstance(outcome, str):
            self.outcomes[outcome] += 1
            return
        self.outcomes["finding"] += 1
        key = outcome.kind, outcome.where
        if key not in self.findings or len(outcome.content) < len(self.findings[key].content):
            self.findings[key] = outcome


def fuzz(
    read: Callable[[Path], object],
    path: Path,
    seeds: Sequence[bytes],
    *,
    count: int,
    generator: Random,
    guided: bool = True,
    before: Callable[[], None] = lambda: None,
) -> Iterator[Tally]:
    """Yield the tally after each of `count` inputs; the same object every time.

    Parameters
    ----------
    read
        The reader.
    path
        Where to write the inputs, one after the other, for it to read.
    seeds
        Whole files to begin with.
    count, generator
        Number of inputs and source of randomness.
    guided
        Follow which lines an input reaches. Otherwise all inputs are made from the whole files.
    before
        Called before each input.
    """
    kept, tally, known = list(seeds), Tally(), Steps()
    for number in range(count):
        # The files themselves come first, and must be read.
        content = seeds[number] if number < len(seeds) else mutate(_pick(kept, generator), generator, seeds)
        path.write_bytes(content)
        before()
        if guided:
            with traced() as steps:
                outcome = judge(read, path, content)
            if not steps <= known:
                known |= steps
                if number >= len(seeds) and len(content) <= LARGEST_KEPT:
                    kept.append(content)
        else:
            outcome = judge(read, path, content)
        tally.add(outcome)
        tally.steps, tally.kept = len(known), len(kept)
        yield tally


def minimise(finding: Finding, read: Callable[[Path], object], path: Path, seconds: float = 5) -> Finding:
    """Return the same finding of a smaller file: pieces are left out, larger ones first, while it stays the same."""
    stop, smallest = time.monotonic() + seconds, finding
    size = max(len(smallest.content) // 2, 1)
    while size:
        at = 0
        while at < len(smallest.content):
            content = smallest.content[:at] + smallest.content[at + size :]
            path.write_bytes(content)
            outcome = judge(read, path, content)
            if isinstance(outcome, Finding) and (outcome.kind, outcome.where) == (finding.kind, finding.where):
                smallest = outcome
            else:
                at += size
            if time.monotonic() > stop:
                return smallest
        size //= 2
    return smallest


def _pick(kept: Sequence[bytes], generator: Random) -> bytes:
    """Prefer what was found last, but come back to everything."""
    return generator.choice(kept if generator.random() < 0.5 else kept[-20:])
