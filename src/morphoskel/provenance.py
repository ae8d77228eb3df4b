"""Fingerprints of code and configuration.

Snakemake sees edits of a script, but not of the modules that the script imports. So each rule carries, as a
parameter, a digest of the library code that it can reach. The digest is taken of the syntax tree without docstrings
and comments: rewording a docstring reruns nothing.
"""

from __future__ import annotations

import ast
import hashlib
import json
import os
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any, TypeGuard

PACKAGE = "morphoskel"
PACKAGE_FOLDER = Path(__file__).resolve().parent


def code_digest(*modules: str) -> str:
    """Return a digest of `modules` and of every module of this package that they import, directly or not.

    Imports inside functions count, and modules that a registry names in a string; imports that only a type checker
    sees do not.

    Parameters
    ----------
    modules
        Dotted names below the package, for example ``chain.dilation``.

    Returns
    -------
    str
        12 hexadecimal digits.

    Raises
    ------
    ModuleNotFoundError
        If there is no such module.
    """
    reached: dict[str, str] = {}
    waiting = [f"{PACKAGE}.{module}" for module in modules]
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached[name], imports = _facts(name)
            waiting += imports
    content = "\n".join(f"{name} {reached[name]}" for name in sorted(reached))
    return hashlib.sha256(content.encode()).hexdigest()[:12]


def remember_digests(path: Path) -> None:
    """Keep what :func:`code_digest` finds out about each source file in `path`, and use what is there already.

    Parsing all of the package takes half a second, which a dry run need not spend when nothing has changed. Facts are
    kept under a hash of the file and of the package's list of files, so they cannot be out of date.

    Parameters
    ----------
    path
        A JSON file, made if it is absent and made anew if it cannot be read.
    """
    global _memory
    try:
        facts = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        facts = {}
    _memory = (path, facts if isinstance(facts, dict) else {})
    _facts.cache_clear()


_memory: tuple[Path, dict[str, Any]] | None = None


@cache
def _facts(name: str) -> tuple[str, list[str]]:
    """Return the digest of a module's syntax tree, and the modules of this package that it imports."""
    path = _find(name)
    if _memory is None or path is None:
        return _tree_digest(name), list(_imports(name))
    file, remembered = _memory
    key = hashlib.sha256(f"{name} {_file_list()} ".encode() + path.read_bytes()).hexdigest()
    if key not in remembered:
        remembered[key] = [_tree_digest(name), list(_imports(name))]
        file.parent.mkdir(parents=True, exist_ok=True)
        partial = file.with_name(f"{file.name}.{os.getpid()}.partial")  # several jobs may start at once
        partial.write_text(json.dumps(remembered), encoding="utf-8")
        partial.replace(file)
    digest, imports = remembered[key]
    return digest, imports


@cache
def _file_list() -> str:
    """Return a hash of the names of the package's files: they decide which imported names are modules."""
    names = sorted(str(path.relative_to(PACKAGE_FOLDER)) for path in PACKAGE_FOLDER.rglob("*.py"))
    return hashlib.sha256("\n".join(names).encode()).hexdigest()


def content_hash(values: Any) -> str:
    """Return 12 hexadecimal digits that identify a structure of plain values, such as a configuration."""
    return hashlib.sha256(json.dumps(values, sort_keys=True, default=str).encode()).hexdigest()[:12]


def _find(name: str) -> Path | None:
    """Return the source file of a dotted module name, or None if it is not a module of this package."""
    relative = Path(*name.split(".")[1:])
    for path in (PACKAGE_FOLDER / relative.with_suffix(".py"), PACKAGE_FOLDER / relative / "__init__.py"):
        if path.is_file():
            return path
    return None


@cache
def _parse(name: str) -> ast.Module:
    path = _find(name)
    if path is None:
        raise ModuleNotFoundError(f"{name}: no such module in {PACKAGE_FOLDER}")
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return _Stripper().visit(tree)  # type: ignore[no-any-return]


@cache
def _tree_digest(name: str) -> str:
    return hashlib.sha256(ast.dump(_parse(name)).encode()).hexdigest()


@cache
def _imports(name: str) -> tuple[str, ...]:
    return tuple(found for node in ast.walk(_parse(name)) for found in _targets(node) if found.split(".")[0] == PACKAGE)


def _targets(node: ast.AST) -> Iterable[str]:
    """Yield the modules that a node names; in ``from package import name``, `name` may be one too."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == PACKAGE:
        yield node.module
        for alias in node.names:
            if _find(f"{node.module}.{alias.name}"):
                yield f"{node.module}.{alias.name}"
    elif isinstance(node, ast.Constant) and _names_module(node.value):
        # A registry names the modules that it imports when they are asked for.
        yield node.value


def _names_module(value: object) -> TypeGuard[str]:
    return isinstance(value, str) and value.startswith(f"{PACKAGE}.") and _find(value) is not None


class _Stripper(ast.NodeTransformer):
    """Removes docstrings, and imports under ``if TYPE_CHECKING``."""

    def visit(self, node: ast.AST) -> Any:
        self.generic_visit(node)
        body = getattr(node, "body", None)
        if isinstance(body, list):
            # A string that stands alone documents what precedes it and does nothing.
            node.body = [statement for statement in body if not _is_text(statement)]  # type: ignore[attr-defined]
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return None
        return node


def _is_text(statement: ast.stmt) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )
