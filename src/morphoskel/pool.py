"""A process pool that survives its workers.

An exception or a native crash in one task never loses the others. A task that failed is tried once more, alone in a
process of its own, where a crash can be told apart by its signal and leaves a traceback in the log. Only a
:class:`~morphoskel.errors.StorageError` ends it all: it concerns every task, and none is to blame for it.
"""

from __future__ import annotations

import faulthandler
import logging
import multiprocessing
import os
import signal
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Generic, TypeVar

from morphoskel.errors import StorageError

logger = logging.getLogger(__name__)

T = TypeVar("T")
R = TypeVar("R")


@dataclass(frozen=True)
class Outcome(Generic[R]):
    """How a task ended.

    Parameters
    ----------
    key
        The task's name.
    result
        What the function returned, or ``None`` if it failed.
    reason
        Empty if the task succeeded, else the exception or the signal that ended it.
    attempts
        1, or 2 if it was retried.
    seconds
        Wall time of the attempt that counts.
    """

    key: str
    result: R | None
    reason: str
    attempts: int
    seconds: float


def run_isolated(
    function: Callable[[T], R], tasks: Mapping[str, T], *, workers: int, preload: Sequence[str] = ()
) -> Iterator[Outcome[R]]:
    """Run `function` on every task in worker processes and yield the outcomes as they come.

    Parameters
    ----------
    function
        A module-level function.
    tasks
        Its argument for each key.
    workers
        Number of processes.
    preload
        Modules imported once and shared by all workers.

    Yields
    ------
    Outcome
        One for each task, in no particular order.

    Raises
    ------
    StorageError
        As soon as a task raises one.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(preload))
    failed: list[str] = []
    for key, ended in _run_pool(function, tasks, workers, context):
        if ended is None:
            failed.append(key)
        else:
            result, seconds = ended
            yield Outcome(key, result, "", 1, seconds)
    for key in failed:
        yield _run_alone(function, key, tasks[key], context)


def _run_pool(
    function: Callable[[T], R], tasks: Mapping[str, T], workers: int, context: Any
) -> Iterator[tuple[str, tuple[R, float] | None]]:
    """Yield each task's result and seconds, or None if it failed or was running when a worker crashed."""
    waiting = deque(tasks)
    running: dict[Future[tuple[R, float]], str] = {}
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=_die_with_parent)
    try:
        while waiting or running:
            # No more tasks are handed out than can run, so that a crash casts suspicion on those few only.
            while waiting and len(running) < workers:
                key = waiting.popleft()
                with _main_hidden():
                    running[pool.submit(_timed, function, tasks[key])] = key
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            broken = False
            for future in done:
                error = future.exception()
                if isinstance(error, StorageError):
                    raise error
                broken = broken or isinstance(error, BrokenProcessPool)
                yield running.pop(future), future.result() if error is None else None
            if broken:
                for key in running.values():
                    yield key, None
                running.clear()
                pool.shutdown(wait=False, cancel_futures=True)
                pool = ProcessPoolExecutor(workers, mp_context=context, initializer=_die_with_parent)
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _run_alone(function: Callable[[T], R], key: str, task: T, context: Any) -> Outcome[R]:
    """Run the task a second time, in a process of its own."""
    receiver, sender = context.Pipe(duplex=False)
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "traceback.txt"
        process = context.Process(target=_report, args=(function, task, sender, trace), name=f"retry of {key}")
        with _main_hidden():
            process.start()
        sender.close()
        try:
            succeeded, value = receiver.recv()
        except EOFError:
            succeeded, value = False, ""
        process.join()
        if trace.exists() and (lines := trace.read_text(errors="replace").strip()):
            logger.error("%s crashed:\n%s", key, lines)
    seconds = time.perf_counter() - start
    if isinstance(value, StorageError):
        raise value
    if succeeded:
        return Outcome(key, value, "", 2, seconds)
    return Outcome(key, None, value or _describe_exit(process.exitcode), 2, seconds)


def _report(function: Callable[[T], R], task: T, sender: Connection, trace: Path) -> None:
    _die_with_parent()
    with trace.open("w") as stream:
        faulthandler.enable(stream)
        try:
            sender.send((True, function(task)))
        except StorageError as error:
            sender.send((False, error))
        except Exception as error:
            sender.send((False, f"{type(error).__name__}: {error}"))
        finally:
            faulthandler.disable()


def _describe_exit(code: int | None) -> str:
    if code is not None and code < 0:
        return f"the process was killed by {signal.Signals(-code).name} (a crash in native code, or out of memory)"
    return f"the process ended with exit code {code} without a result"


@contextmanager
def _main_hidden() -> Iterator[None]:
    """Start workers that do not import the main script, which would run the job again inside each of them."""
    main = sys.modules["__main__"].__dict__
    hidden: dict[str, Any] = {name: main.pop(name) for name in ("__file__", "__spec__") if name in main}
    main["__spec__"] = None
    try:
        yield
    finally:
        main.update(hidden)


def _timed(function: Callable[[T], R], task: T) -> tuple[R, float]:
    start = time.perf_counter()
    return function(task), time.perf_counter() - start


def _die_with_parent() -> None:
    """End this worker when the process that started it is gone, so that a killed job leaves no orphans."""
    parent = multiprocessing.parent_process()
    if parent is None:
        return

    def wait_and_exit() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait_and_exit, daemon=True).start()
