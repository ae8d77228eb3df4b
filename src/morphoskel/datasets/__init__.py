"""The data sets: which shapes they hold, how each is read, and the manifest that pins them.

Nothing here imports a heavy library at module level, since the workflow asks for counts at every parse.
"""

from morphoskel.datasets.dataset import Dataset
from morphoskel.datasets.manifest import Entry, ShapeRecord, build_manifest, read_manifest, write_manifest
from morphoskel.datasets.registry import KINDS, open_dataset

__all__ = [
    "KINDS",
    "Dataset",
    "Entry",
    "ShapeRecord",
    "build_manifest",
    "open_dataset",
    "read_manifest",
    "write_manifest",
]
