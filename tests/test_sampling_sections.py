import copy
import operator

import pytest
from conftest import REPOSITORY
from pydantic import ValidationError

from morphoskel.config import compose
from morphoskel.config.explain import explain_validation
from morphoskel.config.sampling_sections import Samplers
from morphoskel.config.schema import Config
from morphoskel.errors import ConfigError
from morphoskel.sampling.samplers import GENERATORS, SAMPLERS

EXPERIMENTS = sorted(path.stem for path in (REPOSITORY / "config" / "experiment").glob("*.yaml"))


def test_a_section_exists_for_every_sampler():
    assert tuple(Samplers.model_fields) == SAMPLERS
    assert tuple(sorted(path.stem for path in (REPOSITORY / "config" / "sampler").glob("*.yaml"))) == (
        tuple(sorted(SAMPLERS))
    )


@pytest.mark.parametrize("experiment", EXPERIMENTS)
def test_the_sampling_of_every_experiment_is_legal_and_plain(experiment):
    config = compose([f"experiment={experiment}"])
    again = Config.model_validate(config.model_dump(mode="json"))
    assert again == config
    assert again.samplers.names == config.samplers.names
    assert all(config.sampling.points // ratio >= 1 for ratio in config.sampling.ratios)
    assert config.sampling.surface in config.surface.names


def test_all_samplers_run_by_default():
    config = compose()
    assert config.samplers.names == list(SAMPLERS)
    for name in GENERATORS:
        assert getattr(config.samplers, name).epochs > 0
    task, plain = config.tasks.classification.classifier, config.tasks.classification.plain
    assert plain == task.model_copy(update={"dropped_points": 0.0})  # the twin differs by nothing else


@pytest.mark.parametrize(
    ("override", "names"),
    [("sampler=[fps]", ["fps"]), ("sampler=fps", ["fps"]), ("sampler=[snet,random]", ["random", "snet"]),
     ("sampler=[]", [])],
)  # fmt: skip
@pytest.mark.parametrize("experiment", ["demo", "smoke"])
def test_samplers_that_are_not_chosen_are_dropped(experiment, override, names):
    config = compose([f"experiment={experiment}", override])
    assert config.samplers.names == names
    assert Config.model_validate(config.model_dump(mode="json")).samplers.names == names


def test_a_sampler_is_dropped_by_null_and_a_task_by_an_empty_list():
    assert compose(["sampler=[fps,random]", "samplers.random=null"]).samplers.names == ["fps"]
    assert compose(["task=[]"]).tasks.classification is None
    assert compose(["experiment=smoke", "task=[]"]).tasks.classification is None


@pytest.fixture(scope="module")
def values():
    """The values of the default experiment with clouds of the usual size and no parts to transfer to, composed once."""
    return compose(["sampling.points=1024", "task=[classification]"]).model_dump(mode="json")


def validate(values, key, value):
    """Return the configuration with one value changed, as an override would change it."""
    changed = copy.deepcopy(values)
    *parents, name = key.split(".")
    section = changed
    for parent in parents:
        section = section[parent]
    section[name] = value
    try:
        return Config.model_validate(changed)
    except ValidationError as error:
        raise ConfigError(explain_validation(error, changed)) from error


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("sampling.ratios", (1,)),
        ("sampling.ratios", (1024,)),
        ("sampling.points", 64),
        ("sampling.steps", None),
        ("sampling.steps", 1),
        ("sampling.skeleton", "ms3d_coverage"),
        ("sampling.prior.sharpness", 0.0),
        ("sampling.network.dropout", 0.0),
        ("samplers.snet.neighbours", 7),
        ("tasks.classification.teachers", 1),
    ],
)
def test_legal_values(values, key, value):
    assert operator.attrgetter(key)(validate(values, key, value)) == value


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("sampling.points", 1, r"sampling\.points: .*greater than or equal to 2.*points of the clouds"),
        ("sampling.points", 32, "sampling: ratios: expected different numbers of at most 32"),
        ("sampling.ratios", [], r"sampling\.ratios: .*at least 1 item"),
        ("sampling.ratios", [8, 0], r"sampling\.ratios\.1: .*greater than 0"),
        ("sampling.ratios", [8, 8], "sampling: ratios: expected different numbers of at most 1024"),
        ("sampling.ratios", [1025], "sampling: ratios: expected different numbers of at most 1024"),
        ("sampling.seeds", 0, r"sampling\.seeds: .*greater than 0.*trainings"),
        ("sampling.draws", 0, r"sampling\.draws: .*greater than 0.*choices"),
        ("sampling.steps", 0, r"sampling\.steps: .*greater than 0.*null: as long as its epochs say"),
        ("sampling.validation_share", 0, r"sampling\.validation_share: .*greater than 0"),
        ("sampling.validation_share", 1, r"sampling\.validation_share: .*less than 1"),
        ("sampling.skeleton", "dpc", r"sampling\.skeleton: .*'ms3d' or 'ms3d_coverage'"),
        ("sampling.prior.bins", 0, r"sampling\.prior: bins: expected at least 1, got 0"),
        ("sampling.prior.sharpness", -1, r"sampling\.prior: sharpness: expected a finite number"),
        ("sampling.network.k", 0, r"sampling\.network: k: expected at least 1"),
        ("sampling.network.temperature_end", 2, r"sampling\.network: temperature: expected start >= end"),
        ("sampling.size", 3, r"sampling\.size: no such key; Legal: draws, network, points"),
        ("samplers.lfs.floor", -1, r"samplers\.lfs: floor"),
        ("samplers.snet.augmentation", "flip", r"samplers\.snet.*augmentation"),
        ("samplers.skeleton_aware.skeleton.hops", -1, r"samplers\.skeleton_aware\.skeleton: hops"),
        ("samplers.random.size", 3, r"samplers\.random\.size: no such key"),
        ("samplers.random", 3, r"samplers\.random: "),
        ("tasks.classification.teachers", 0, r"tasks\.classification\.teachers: .*greater than 0"),
        ("tasks.classification.classifier.dropped_points", 1, r"tasks\.classification\.classifier: dropped_points"),
    ],
)
def test_illegal_values_are_named(values, key, value, message):
    with pytest.raises(ConfigError, match=message):
        validate(values, key, value)


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("sampler=[fps,fpps]", r"sampler: no such choice 'fpps'; did you mean 'fps'"),
        ("task=[clasification]", r"task: no such choice 'clasification'; did you mean 'classification'"),
        ("sampling.seed=2", r"sampling\.seed: no such key; did you mean 'sampling\.seeds'"),
    ],
)
def test_wrong_names_are_explained(override, message):
    with pytest.raises(ConfigError, match=message):
        compose([override])
