"""Keep a training from going on with files that are damaged."""

import logging
import shutil
from pathlib import Path

from morphoskel.checksums import intact_archive
from morphoskel.errors import StorageError

logger = logging.getLogger(__name__)


def discard_damaged(folder: Path, last: str, best: str) -> None:
    """Remove the checkpoints of a phase if one of them is damaged, or the best is missing beside the last.

    The phase then starts anew. It ends with the same weights: they depend on the seed and the data alone.

    Parameters
    ----------
    folder
        Of the checkpoints; it need not exist.
    last, best
        Names of the checkpoint to go on from, and of the one whose weights are kept.
    """
    if not (folder / last).exists():
        return
    try:
        for name in (last, best):
            intact_archive(folder / name)
    except (StorageError, FileNotFoundError) as error:
        logger.warning("%s; this phase of the training starts anew", error)
        shutil.rmtree(folder)


def is_finished(result: Path) -> bool:
    """Tell whether the network of a finished training is there; a damaged one is removed, to be written again."""
    if not result.exists():
        return False
    try:
        intact_archive(result)
    except StorageError as error:
        logger.warning("%s; the network is written again from the checkpoints", error)
        result.unlink()
        return False
    return True
