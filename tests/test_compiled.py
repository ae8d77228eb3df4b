import ast
import threading

import pytest
from conftest import REPOSITORY

from morphoskel.compiled import run_blocks

SOURCES = {path: ast.parse(path.read_text()) for path in (REPOSITORY / "src").rglob("*.py")}


@pytest.mark.parametrize("threads", [1, 2, 7])
@pytest.mark.parametrize("count", [0, 1, 10, 1001])
def test_blocks_cover_the_range_in_order(threads, count):
    blocks = run_blocks(lambda start, stop: range(start, stop), count, block=10, threads=threads)
    assert [item for block in blocks for item in block] == list(range(count))


def test_blocks_run_side_by_side():
    meeting = threading.Barrier(2, timeout=10)
    assert sorted(run_blocks(lambda _start, _stop: meeting.wait(), 2, block=1, threads=2)) == [0, 1]


def test_an_error_in_a_block_is_raised():
    with pytest.raises(ZeroDivisionError):
        run_blocks(lambda start, _stop: 1 // start, 4, block=1, threads=2)


def kernels_of(tree):
    return {
        node.name
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
        and any(isinstance(item, ast.Name) and item.id == "kernel" for item in node.decorator_list)
    }


def test_kernels_call_only_kernels_of_their_own_file():
    """The compiler's cache does not see that a kernel in another file has changed, and would run stale code."""
    owners = {path: names for path, tree in SOURCES.items() if (names := kernels_of(tree))}
    assert len(owners) >= 4
    for path, own in owners.items():
        foreign = set().union(*(names for other, names in owners.items() if other != path))
        imported = {alias.name for node in ast.walk(SOURCES[path]) if isinstance(node, ast.ImportFrom)
                    for alias in node.names}  # fmt: skip
        assert not imported & foreign, path
        assert own
