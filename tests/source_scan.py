"""Find calls in Python sources that let data run code, hand names to a shell, or trust an archive or an address."""

from __future__ import annotations

import ast
from collections.abc import Iterator

REQUIRED = {
    "torch.load": ("weights_only", True),
    "numpy.load": ("allow_pickle", False),
    "numpy.lib.npyio.NpzFile": ("allow_pickle", False),
    "numpy.lib.format.read_array": ("allow_pickle", False),
}
"""Functions that are safe with one argument only."""

REQUIRED_OF_METHODS = {"load_from_checkpoint": ("weights_only", True)}

FORBIDDEN = {
    "eval", "exec", "compile", "__import__", "os.system", "os.popen", "subprocess.getoutput",
    "subprocess.getstatusoutput", "yaml.load", "yaml.load_all", "yaml.full_load", "yaml.unsafe_load", "torch.jit.load",
    "torch.hub.load", "shutil.unpack_archive", "tempfile.mktemp", "hydra.utils.instantiate", "hydra.utils.call",
    "hydra.utils.get_class", "hydra.utils.get_method", "urllib.request.urlopen", "urllib.request.urlretrieve",
}  # fmt: skip

FORBIDDEN_METHODS = {"read_pickle", "read_hdf", "to_pickle", "extractall", "unsafe_load"}

FORBIDDEN_MODULES = {"marshal", "shelve", "dill", "joblib", "cloudpickle", "cPickle"}

ERRORS_OF_PICKLE = {"pickle.UnpicklingError", "pickle.PickleError"}


def findings(source: str) -> Iterator[str]:
    """Yield ``line: what`` for everything that is forbidden in a module's source."""
    tree = ast.parse(source)
    aliases = _aliases(tree)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            modules = [node.module or ""] if isinstance(node, ast.ImportFrom) else [name.name for name in node.names]
            yield from (f"{node.lineno}: imports {name}" for name in modules if name.split(".")[0] in FORBIDDEN_MODULES)
        name = _name(node, aliases)
        if name.startswith("pickle.") and name not in ERRORS_OF_PICKLE:
            yield f"{node.lineno}: {name}"
        if isinstance(node, ast.Call) and (reason := _unsafe(node, aliases)):
            yield f"{node.lineno}: {reason}"


def _aliases(tree: ast.Module) -> dict[str, str]:
    """Return what the imported names of a module stand for."""
    aliases = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            aliases |= {name.asname: name.name for name in node.names if name.asname}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            aliases |= {name.asname or name.name: f"{node.module}.{name.name}" for name in node.names}
    return aliases


def _name(node: ast.AST, aliases: dict[str, str]) -> str:
    """Return the dotted name of an expression, or ``""`` if it has none."""
    if isinstance(node, ast.Name):
        return aliases.get(node.id, node.id)
    if isinstance(node, ast.Attribute):
        before = _name(node.value, aliases)
        return f"{before}.{node.attr}" if before else ""
    return ""


def _unsafe(call: ast.Call, aliases: dict[str, str]) -> str:
    name = _name(call.func, aliases)
    method = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    arguments = {keyword.arg: keyword.value for keyword in call.keywords}
    if name in FORBIDDEN or method in FORBIDDEN_METHODS:
        return name or method
    required = REQUIRED.get(name) or REQUIRED_OF_METHODS.get(method)
    if "ckpt_path" in arguments:
        required = ("weights_only", True)
    if required and not _is(arguments.get(required[0]), required[1]):
        return f"{name or method} without {required[0]}={required[1]}"
    if not _is(arguments.get("shell", ast.Constant(False)), False):
        return f"{name or method} with a shell"
    if _is(arguments.get("allow_pickle"), True):
        return f"{name or method} with pickled objects"
    return ""


def _is(node: ast.expr | None, value: bool) -> bool:
    return isinstance(node, ast.Constant) and node.value is value
