"""Train a network that tells parts, on the points that a sampler chose to be labelled, from files to a file."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.errors import InputError
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.plain_values import as_tuples
from morphoskel.networks.segmentation_settings import SegmentationSettings
from morphoskel.provenance import content_hash
from morphoskel.sampling.labelled_points import LabelRequest, labelled_mask, read_label_sets
from morphoskel.seeds import derive_seed
from morphoskel.shapes import IntArray

if TYPE_CHECKING:
    from morphoskel.learning.segmentation_phase import LabelledClouds

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class _Shapes:
    """Clouds and their labelled points.

    Parameters
    ----------
    points, labels, parts, class_names, part_classes
        As of a :class:`~morphoskel.datasets.cloud_set.CloudSet`.
    labelled
        ``(S, D, N)`` bool, D sets of labelled points.
    """

    points: npt.NDArray[np.float32]
    labels: npt.NDArray[np.int64]
    parts: npt.NDArray[np.int64]
    class_names: list[str]
    part_classes: list[int]
    labelled: npt.NDArray[np.bool_]

    def with_every_label(self) -> _Shapes:
        """Return the same clouds with all points labelled but the repeated ones."""
        return replace(self, labelled=(self.parts >= 0)[:, None])

    def tensors(self, positions: IntArray, case: str) -> LabelledClouds:
        """Return the shapes at `positions` but those without labelled points; `case` names them in the log."""
        import torch

        from morphoskel.learning.segmentation_phase import LabelledClouds

        known = positions[np.all(self.labelled[positions].any(axis=2), axis=1)]
        if len(known) < len(positions):
            without = len(positions) - len(known)
            logger.warning("%s: nothing was chosen of %d of %d shapes; left out", case, without, len(positions))
        arrays = [array[known] for array in (self.points, self.labels, self.parts, self.labelled)]
        if len(known):
            of_shape = arrays[-1].sum(axis=2).mean()
            logger.info("%s: %d shapes with %.1f labelled points each", case, len(known), of_shape)
        return LabelledClouds(*map(torch.from_numpy, arrays))


def train_segmentation_on_files(
    strategy: str,
    ratio: int,
    number: int,
    clouds: Sequence[Path],
    samples: Sequence[Path],
    result: Path,
    checkpoints: Path,
    *,
    seed: int,
    settings: Mapping[str, Any],
    validation_clouds: Path | None,
    validation_samples: Path | None,
    validation_share: float,
    validation_labels: Literal["labelled", "all"],
    completed: bool,
    label_sets: int,
    full_supervision: Mapping[str, Any],
    accelerator: str = "auto",
    devices: int = 1,
    threads: int = 1,
) -> None:
    """Train one network on the points that one sampler chose and write it to a file.

    Parameters
    ----------
    strategy
        Name of what chose the labelled points, for the file.
    ratio
        Points of a cloud for each labelled point.
    number
        Of the training, from 0. Trainings with the same number start with the same weights and show the shapes in the
        same order, whatever the strategy and the ratio.
    clouds
        Files of the training splits' clouds, with parts.
    samples
        Folders with the points chosen of each of them; none if all points are labelled. Shapes of which nothing was
        chosen are left out.
    result
        The file to write.
    checkpoints
        Folder of checkpoints and logs, as in :func:`~morphoskel.learning.sampler_training.train_sampler_on_files`.
    seed
        The global seed; on this alone depends which shapes are held out.
    settings
        Fields of :class:`~morphoskel.networks.segmentation_settings.SegmentationSettings`.
    validation_clouds, validation_samples
        The same of the validation split, by which the epoch is chosen; ``None`` to hold out training shapes.
    validation_share
        Share of the training shapes of each category to hold out.
    validation_labels
        labelled: as many points of a validation shape are labelled as of a training shape; all: all of them.
    completed, label_sets
        See :class:`~morphoskel.sampling.labelled_points.LabelRequest`.
    full_supervision
        Settings that take the place of the others without `samples`; ``None`` leaves one as it is.
    accelerator, devices, threads
        Where to train, and with how many threads of a processor.

    Raises
    ------
    InputError
        If files do not belong together, or too few points or shapes are left.
    """
    import torch

    from morphoskel.learning.train_segmentation import train_segmentation

    torch.set_num_threads(threads)
    chosen = SegmentationSettings(**{name: as_tuples(value) for name, value in settings.items()})
    if not samples:
        chosen = chosen.changed(full_supervision)
    request = LabelRequest(ratio, number, label_sets, completed)
    shapes = judged = _read(clouds, samples, request)
    if validation_clouds is None:
        positions = hold_out([shapes.class_names[label] for label in shapes.labels], validation_share, seed)
    else:
        if samples and validation_samples is None and validation_labels == "labelled":
            raise InputError(f"{validation_clouds}: expected a folder with the points chosen of these clouds, too")
        judged = _read([validation_clouds], [validation_samples] if samples and validation_samples else [], request)
        _check_alike([clouds[0], validation_clouds], [shapes, judged])
        positions = np.arange(len(shapes.labels)), np.arange(len(judged.labels))
    if validation_labels == "all":
        judged = judged.with_every_label()
    training = shapes.tensors(positions[0], f"{strategy}, ratio {ratio}, training")
    validation = judged.tensors(positions[1], f"{strategy}, ratio {ratio}, validation")
    origin = {"strategy": strategy, "ratio": ratio, "number": number}
    parts_of = shapes.class_names, shapes.part_classes
    # The data are known by themselves, not by their files: a folder of samples also holds those of other ratios.
    digests = [hashlib.sha256(tensor.numpy().tobytes()).hexdigest() for tensor in (*training, *validation)]
    trained = train_segmentation(
        training,
        validation,
        *parts_of,
        chosen,
        checkpoints / content_hash([origin, repr(chosen), seed, threads, devices, *parts_of, *digests]),
        # Neither strategy nor ratio is part of the seed, so that trainings which differ in them can be compared in
        # pairs: the noise of the initial weights and of the order of the shapes is common to both.
        derive_seed(seed, "segmentation", str(number)),
        origin=origin,
        accelerator=accelerator,
        devices=devices,
    )
    with atomic_file(result) as partial:
        partial.write_bytes(trained.read_bytes())


def _read(clouds: Sequence[Path], samples: Sequence[Path], request: LabelRequest) -> _Shapes:
    """Return the clouds of several files as one, with the points of each that were chosen, or all of them."""
    folders: Sequence[Path | None] = samples or [None] * len(clouds)
    if len(folders) != len(clouds):
        raise InputError(f"expected a folder of chosen points for each of {len(clouds)} files, got {len(samples)}")
    files = [_read_file(path, folder, request) for path, folder in zip(clouds, folders, strict=True)]
    _check_alike(clouds, files)
    if len({of_file.labelled.shape[1] for of_file in files}) > 1:
        raise InputError(f"{', '.join(map(str, samples))}: expected the points that one sampler chose; choose again")
    return replace(
        files[0],
        points=np.concatenate([of_file.points for of_file in files]),
        labels=np.concatenate([of_file.labels for of_file in files]),
        parts=np.concatenate([of_file.parts for of_file in files]),
        labelled=np.concatenate([of_file.labelled for of_file in files]),
    )


def _read_file(path: Path, folder: Path | None, request: LabelRequest) -> _Shapes:
    """Return the clouds of a file with the points labelled that a folder holds, or all of them."""
    clouds = read_cloud_set(path)
    if clouds.parts is None or clouds.part_classes is None:
        raise InputError(f"{path}: its clouds have no parts; expected those of a data set with parts")
    shapes = _Shapes(
        clouds.points, clouds.labels, clouds.parts, clouds.class_names.tolist(), clouds.part_classes.tolist(),
        labelled=np.empty((len(clouds), 0, clouds.points.shape[1]), dtype=np.bool_),
    ).with_every_label()  # fmt: skip
    if folder is None:
        return shapes
    draws = read_label_sets(folder, request)
    lengths, points = clouds.lengths, clouds.points.shape[1]
    try:
        masks = [labelled_mask(indices, lengths, points) for indices in draws]
    except InputError as error:
        raise InputError(f"{folder}: not chosen of the clouds in {path}: {error}") from error
    return replace(shapes, labelled=np.stack(masks, axis=1))


def _check_alike(paths: Sequence[Path], files: Sequence[_Shapes]) -> None:
    """Refuse clouds of other categories, parts or sizes than the first."""
    expected, *others = ((file.class_names, file.part_classes, file.points.shape[1]) for file in files)
    for path, found in zip(paths[1:], others, strict=True):
        if found != expected:
            raise InputError(
                f"{path}: expected the categories, parts and number of points of {paths[0]}; make both files again "
                "from one data set"
            )
