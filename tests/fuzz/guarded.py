"""Run the loop in a process of its own, with limits, so that a crash or a hang is found like any other fault."""

from __future__ import annotations

import logging
import multiprocessing
import random
import resource
import signal
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from fuzz.judge import Finding
from fuzz.loop import Tally, fuzz, minimise
from morphoskel.progress import count_up
from morphoskel.seeds import derive_seed

MOST_CPU_SECONDS, MOST_WALL_SECONDS = 10, 120
"""Limits of one input, kept by the kernel, which also ends native code. Machines are busy: wall time is generous."""

MOST_ADDRESS_SPACE = 2 << 30
"""Bytes that the process may map beyond what it has when the reader is imported."""

REPORT_EVERY = 500
"""Inputs between two reports of the process to its parent, which are all that a crash can lose count of."""

_SIGNALS = {signal.SIGPROF: "hang", signal.SIGALRM: "hang", signal.SIGKILL: "memory"}


@dataclass(frozen=True)
class Result:
    """What came of a reader's inputs, over all processes that were needed."""

    reader: str
    seed: int
    inputs: int
    read: int
    refused: int
    steps: int
    kept: int
    seconds: float
    findings: tuple[Finding, ...]


def fuzz_reader(name: str, *, count: int, seed: int) -> Result:
    """Feed `count` inputs to a reader; after a crash, a new process does what is left."""
    started, total = time.monotonic(), Tally()
    with (
        tempfile.TemporaryDirectory(prefix="morphoskel-fuzz-") as folder,
        count_up(name, unit="input", total=count) as advance,
    ):
        for attempt in range(50):  # a reader that crashes so often need not be tested further
            left = count - total.outcomes.total()
            if left <= 0:
                break
            _merge(
                total, *_run(name, Path(folder) / str(attempt), left, derive_seed(seed, name, str(attempt)), advance)
            )
    return Result(
        name, seed, total.outcomes.total(), total.outcomes["read"], total.outcomes["refused"], total.steps, total.kept,
        time.monotonic() - started, tuple(total.findings.values()),
    )  # fmt: skip


def _run(
    name: str, folder: Path, count: int, seed: int, advance: Callable[[int], None]
) -> tuple[Tally, Finding | None]:
    """Return what a process reports, and what it died of, if it did; tell how many more inputs each report counts."""
    folder.mkdir()
    context = multiprocessing.get_context("fork")  # what is imported already need not be imported again
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(name, folder, count, seed, send))
    process.start()
    send.close()
    tally, last = Tally(), None
    try:
        while True:
            message: Any = receive.recv()
            if isinstance(message, Path):
                last = message
            else:
                advance(message.outcomes.total() - tally.outcomes.total())
                tally = message
    except EOFError:
        process.join()
    if process.exitcode == 0:
        return tally, None
    code = process.exitcode or 0
    if last is None:
        raise RuntimeError(f"{name}: its process ended with {code} before the first input")
    kind = _SIGNALS.get(signal.Signals(-code), "crash") if code < 0 else "crash"
    return tally, Finding(kind, f"exit code {code}", last.read_bytes())


def _work(name: str, folder: Path, count: int, seed: int, send: Connection) -> None:
    from fuzz.readers import READERS

    logging.disable()
    reader = READERS[name]
    path = folder / reader.file
    path.parent.mkdir(parents=True, exist_ok=True)
    seeds = reader.seeds(folder)
    reader.warm_up(path, seeds)
    _limit_memory()
    send.send(path)
    tally = Tally()
    for tally in fuzz(reader.read, path, seeds, count=count, generator=random.Random(seed), before=_restart_clocks):
        if tally.outcomes.total() % REPORT_EVERY == 0:
            send.send(tally)
    _stop_clocks()
    tally.findings = {key: minimise(finding, reader.read, path) for key, finding in tally.findings.items()}
    send.send(tally)


def _limit_memory() -> None:
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    limit = pages * resource.getpagesize() + MOST_ADDRESS_SPACE
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _restart_clocks() -> None:
    """Let the kernel end this process, by the default action of the signals, if the next input takes too long."""
    signal.setitimer(signal.ITIMER_PROF, MOST_CPU_SECONDS)
    signal.setitimer(signal.ITIMER_REAL, MOST_WALL_SECONDS)


def _stop_clocks() -> None:
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)


def _merge(total: Tally, tally: Tally, death: Finding | None) -> None:
    total.outcomes += tally.outcomes
    total.steps, total.kept = max(total.steps, tally.steps), max(total.kept, tally.kept)
    for finding in tally.findings.values():
        total.findings.setdefault((finding.kind, finding.where), finding)
    if death is not None:
        total.add(death)
