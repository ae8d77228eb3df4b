"""How the hot loops are compiled, and how they share the cores."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

Result = TypeVar("Result")


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function to machine code, once for all processes that follow: the code is cached on disk.

    A kernel runs without the interpreter's lock, so several threads can run it at once on blocks of the same arrays.
    It does not start threads itself: nothing global decides how many there are, and a process may be forked at any
    time. Floating-point operations keep their order, so results do not depend on the machine's vector width.

    A cached kernel is compiled anew when its own file changes, but not when a kernel that it calls from another file
    does; therefore kernels call only kernels of their own file.
    """
    import numba

    compiled: Callable[..., Any] = numba.njit(cache=True, nogil=True, error_model="numpy")(function)
    return compiled


def run_blocks(work: Callable[[int, int], Result], count: int, *, block: int, threads: int) -> list[Result]:
    """Call ``work(start, stop)`` on consecutive blocks of ``range(count)``, several at a time.

    Parameters
    ----------
    work
        Calls a kernel; blocks must not write to the same places.
    count
        Number of items.
    block
        Items a call; many more blocks than threads, so that no thread waits long for the last one.
    threads
        Calls at a time.

    Returns
    -------
    list
        What the calls returned, in the order of the blocks.
    """
    starts = range(0, count, block)
    if threads == 1 or len(starts) == 1:
        return [work(start, min(start + block, count)) for start in starts]
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(lambda start: work(start, min(start + block, count)), starts))
