"""The errors this package raises on purpose.

Every message says what is wrong, where (file, shape id or configuration key), what was expected,
and how to mend it. Anything else that escapes is a defect of ours.
"""


class MorphoSkelError(Exception):
    """Base class of every error raised on purpose."""


class InputError(MorphoSkelError, ValueError):
    """A file or an array handed in by the user is not what it should be."""


class DatasetError(MorphoSkelError):
    """A data set is missing, incomplete, or does not match its manifest."""


class ConfigError(MorphoSkelError, ValueError):
    """A configuration key or value is not legal."""


class StorageError(MorphoSkelError):
    """A file of the run cannot be written, as on a full disk, or is not what was written; no shape is to blame."""


class ShapeError(MorphoSkelError):
    """One shape cannot pass a stage of the chain; the other shapes are not affected."""
