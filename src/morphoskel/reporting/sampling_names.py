"""The rows of the sampling tables: what they are called, which table has them, and in which order."""

from morphoskel.errors import InputError
from morphoskel.sampling.choice import ARGMAX, COMPLETED, DRAWN, FIXED
from morphoskel.sampling.samplers import PRIORS

SAMPLER_NAMES = {
    "all_points": "All points",
    "random": "Random",
    "fps": "FPS",
    "lfs": "LFS-weighted FPS",
    "snet": "S-NET",
    "samplenet": "SampleNet",
    "metasampler": "MetaSampler",
    "skeleton_aware": "SA",
    "ms3d": "MS3D",
    "dpc": "DPC",
    "l1_medial": "L1",
    "uniform": "uniform prior",
    "shuffled": "shuffled prior",
}
"""Samplers in the order of the rows, with the paper's names where it has them."""

ALL_POINTS = "all_points"

CHOICE_SUFFIXES = {FIXED: "", DRAWN: "", ARGMAX: ", arg-max", COMPLETED: ", completed"}
"""Ways in which a sampler chooses points; the first two are the usual one of a sampler and leave its name alone."""

PLAIN_CLASSIFIER = ", classifier without point dropout"
"""End of the name of a row whose task network is the twin that was trained without point dropout."""

CLASSIFIER_SUFFIXES = {"dropout": "", "plain": PLAIN_CLASSIFIER}

COMPARISONS = (("ms3d", "skeleton_aware"), ("ms3d", "uniform"), ("ms3d", "shuffled"), ("ms3d", "random"))
"""Samplers whose accuracies are subtracted; the paper prints the first two in one table."""

PRIOR_TABLE = "skeleton_prior"
SAMPLER_TABLES = ("object_classification", "point_cloud_retrieval")
SAMPLING_TABLES = (*SAMPLER_TABLES, PRIOR_TABLE)

_PRIOR_SAMPLERS = ("random", *PRIORS)
_OTHER_SKELETONS = ("dpc", "l1_medial")
_CHOSEN_OTHERWISE = (ARGMAX, COMPLETED)


def row_name(sampler: str, choice: str, classifier: str) -> str:
    """Return the name of a row.

    Parameters
    ----------
    sampler
        One of :data:`SAMPLER_NAMES`.
    choice
        One of :data:`CHOICE_SUFFIXES`.
    classifier
        One of :data:`CLASSIFIER_SUFFIXES`.

    Raises
    ------
    InputError
        If a name is unknown.
    """
    for name, kind, known in (
        (sampler, "sampler", SAMPLER_NAMES),
        (choice, "choice", CHOICE_SUFFIXES),
        (classifier, "classifier", CLASSIFIER_SUFFIXES),
    ):
        if name not in known:
            raise InputError(f"there is no {kind} {name!r}; known are {', '.join(known)}")
    return SAMPLER_NAMES[sampler] + CHOICE_SUFFIXES[choice] + CLASSIFIER_SUFFIXES[classifier]


def difference_name(first: str, second: str, choice: str) -> str:
    """Return the name of the row that subtracts the second sampler from the first."""
    return f"{SAMPLER_NAMES[first]} minus {SAMPLER_NAMES[second]}{CHOICE_SUFFIXES[choice]}"


def belongs(table: str, sampler: str, choice: str, classifier: str) -> bool:
    """Return whether a table has that row.

    The table of priors compares priors and random points, drawn and by arg-max, under one classifier. The others
    compare samplers as they are meant to choose, under both classifiers, and the other choices of SA and MS3D.
    """
    if table == PRIOR_TABLE:
        return sampler in _PRIOR_SAMPLERS and choice != COMPLETED and classifier == "dropout"
    if sampler in (ALL_POINTS, *_OTHER_SKELETONS):
        return False
    return choice not in _CHOSEN_OTHERWISE or (sampler in ("skeleton_aware", "ms3d") and classifier == "dropout")


def ordered_names() -> list[str]:
    """Return every name of a row: usual choices in the order of the samplers, other choices, twins, differences."""
    names = [
        row_name(sampler, choice, classifier)
        for classifier in CLASSIFIER_SUFFIXES
        for choices in ((DRAWN,), _CHOSEN_OTHERWISE)
        for sampler in SAMPLER_NAMES
        for choice in choices
    ]
    return names + [difference_name(*pair, choice) for choice in (DRAWN, ARGMAX) for pair in COMPARISONS]
