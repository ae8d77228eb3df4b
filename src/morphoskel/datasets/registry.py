"""Open a data set by the name of its kind."""

from __future__ import annotations

import difflib
import importlib
import inspect
from typing import Any

from morphoskel.datasets.dataset import Dataset
from morphoskel.errors import ConfigError

KINDS: dict[str, tuple[str, str]] = {
    "synthetic": ("morphoskel.datasets.synthetic", "SyntheticDataset"),
    "point2skeleton": ("morphoskel.datasets.point2skeleton", "Point2SkeletonDataset"),
    "modelnet40": ("morphoskel.datasets.modelnet40", "ModelNet40Dataset"),
    "shapenetpart": ("morphoskel.datasets.shapenetpart", "ShapeNetPartDataset"),
    "class_tree": ("morphoskel.datasets.class_tree", "ClassTreeDataset"),
    "folder": ("morphoskel.datasets.folder", "FolderDataset"),
}
"""Module and class of each kind; a module is imported only when its kind is asked for."""


def open_dataset(kind: str, **options: Any) -> Dataset:
    """Return the data set of this kind.

    Parameters
    ----------
    kind
        One of :data:`KINDS`.
    options
        Arguments of the data set's class, for example ``root`` and ``categories``.

    Raises
    ------
    ConfigError
        If the kind, or one of the options, is unknown or missing.
    DatasetError
        If the data set refuses an option's value.
    """
    if kind not in KINDS:
        near = difflib.get_close_matches(kind, KINDS, n=1)
        hint = f" Did you mean {near[0]!r}?" if near else ""
        raise ConfigError(f"dataset.kind: unknown kind {kind!r}.{hint} Legal kinds: {', '.join(KINDS)}")
    module, name = KINDS[kind]
    dataset_class = getattr(importlib.import_module(module), name)
    signature = inspect.signature(dataset_class)
    try:
        signature.bind(**options)
    except TypeError as error:
        legal = ", ".join(signature.parameters)
        raise ConfigError(f"dataset of kind {kind!r}: {error}; its options are {legal}") from error
    dataset: Dataset = dataset_class(**options)
    return dataset
