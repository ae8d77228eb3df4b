import pytest
import yaml
from conftest import REPOSITORY

from morphoskel.config import compose, config_folder
from morphoskel.errors import ConfigError

EXPERIMENTS = sorted(path.stem for path in (REPOSITORY / "config" / "experiment").glob("*.yaml"))


def test_the_default_is_the_demo():
    config = compose()
    assert config.run == "demo"
    assert config.dataset.kind == "synthetic"
    assert config.surface.names == ["poisson", "ball_pivoting", "alpha_shape", "ponq", "repaired_poisson"]
    assert config.methods.names == ["coverage_axis", "l1_medial", "dpc", "point2skeleton"]
    assert config.skeleton.selection == ("residue", "coverage")


@pytest.mark.parametrize("experiment", EXPERIMENTS)
def test_every_experiment_composes_and_is_named_like_its_file(experiment):
    assert compose([f"experiment={experiment}"]).run == experiment


@pytest.mark.parametrize("dataset", sorted(path.stem for path in (REPOSITORY / "config" / "dataset").glob("*.yaml")))
def test_every_data_set_composes(dataset):
    config = compose([f"dataset={dataset}", "dataset.root=/somewhere"])
    assert config.dataset.name == dataset
    assert str(config.dataset.root) == "/somewhere"


@pytest.mark.parametrize(
    ("overrides", "segmented"),
    [
        ([], "synthetic_parts"),
        (["dataset=modelnet40"], "shapenetpart"),
        (["dataset=shapenetpart"], "shapenetpart"),
        (["~parts"], "synthetic"),
        (["dataset=class_tree", "dataset.root=/a"], None),
        (["dataset=class_tree", "dataset.root=/a", "parts=shapenetpart", "parts.root=/b"], "shapenetpart"),
    ],
)
def test_parts_are_those_of_the_second_data_set_or_else_of_the_first(overrides, segmented):
    config = compose(overrides)
    assert (config.segmented and config.segmented.name) == segmented
    if config.parts is None and segmented:
        assert config.segmented is config.dataset


def test_an_override_beats_the_experiment():
    config = compose(["experiment=paper", "skeleton.candidates.count=5000", "surface=[alpha_shape]"])
    assert config.skeleton.candidates.count == 5000
    assert config.surface.names == ["alpha_shape"]


def test_a_group_can_be_given_as_one_or_as_a_list():
    alone = compose(["skeleton=ms3d", "surface=ponq", "skeleton.selection=coverage"])
    assert (alone.methods.names, alone.surface.names, alone.skeleton.selection) == ([], ["ponq"], ("coverage",))
    listed = compose(["skeleton=[dpc,ms3d]", "surface=[ponq]", "skeleton.selection=[coverage,residue]"])
    assert (listed.methods.names, listed.surface.names) == (["dpc"], ["ponq"])
    assert listed.skeleton.selection == ("coverage", "residue")


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("skeleton.kk=3", r"skeleton\.kk: no such key; did you mean 'skeleton\.k'\? Legal: .*skeleton\.points"),
        ("skelton.k=3", r"skelton\.k: no such key; did you mean 'skeleton\.k'"),
        ("protocl=released", r"protocl: no such key; did you mean 'protocol'"),
        ("+skeleton.size=3", r"skeleton\.size: no such key"),
        ("skeleton.k=one", r"skeleton\.k: .*valid integer.*'one'.*structuring element"),
        ("skeleton.k=1", r"skeleton\.k: .*greater than or equal to 2"),
        ("skeleton.candidates.mode=gird", r"skeleton\.candidates\.mode: .*'random' or 'grid'.*'gird'"),
        ("dataset=pont2skeleton", r"did you mean 'point2skeleton'\? Legal: class_tree, .*synthetic"),
        ("surface=[poisson,bpa]", r"surface: no such choice 'bpa'; .*ball_pivoting"),
        ("skeleton=[ms3d,dcp]", r"skeleton: no such choice 'dcp'; did you mean 'dpc'"),
        ("skeleton=[dpc]", r"skeleton\.k: missing"),
        ("skeleton.selection=[residue,largest]", r"skeleton\.selection\.1: .*'residue' or 'coverage'"),
        ("skeleton.selection=[]", r"skeleton\.selection: .*at least 1 item"),
        ("samplers.fps.start=1", r"samplers\.fps\.start: no such key; samplers\.fps has no settings"),
        ("methods.dpc.stp=1", r"methods\.dpc\.stp: no such key; did you mean 'methods\.dpc\.step'"),
        ("methods.dpc.step=-1", r"methods\.dpc: .*step: expected a finite number that is not negative, got -1"),
        ("methods.l1_medial.samples=1", r"methods\.l1_medial: .*samples must be from 2"),
        ("methods.l1_medial.recentre=maybe", r"methods\.l1_medial\.recentre: .*boolean.*'maybe'.*centres of the sec"),
        ("evaluation.equal_counts=[100,0]", r"evaluation\.equal_counts\.1: .*greater than 0, got 0"),
        ("medial_axis.separation_angle=180", r"medial_axis\.separation_angle: .*less than 180"),
        ("trainer.accelerator=tpu", r"trainer\.accelerator: .*'auto', 'cpu' or 'gpu'"),
        ("experiment=papr", r"did you mean 'paper'"),
        ("dataset=folder", r"dataset\.root: has no default; set it"),
        ("dataset.url=3", r"dataset\.url"),
        ("shard_size=0", r"shard_size: .*greater than 0, got 0"),
        ("run=a/b", r"run: .*pattern"),
        ("parts=null", r"parts: null is no choice; to choose none, write ~parts"),
        ("parts=sharenetpart", r"parts: no such choice 'sharenetpart'; did you mean 'shapenetpart'"),
        ("parts.name=synthetic", r"^parts: expected a name other than synthetic.*write ~parts"),
        ("parts.per_category=3", r"^parts\.per_category: .*got 3"),
        (
            "tasks.segmentation.ratios=[16,8]",
            r"^tasks\.segmentation: ms3d, uniform would have to choose 64, 128 points",
        ),
        ("tasks.segmentation.strategies=[fps,fps]", r"^tasks\.segmentation: strategies: expected different samplers"),
        ("tasks.segmentation.strategies=[fsp]", r"^tasks\.segmentation\.strategies\.0: .*'fsp'"),
        ("nonsense", r"'nonsense' is not an override; expected key=value"),
        ("a=b=[", r"is not an override"),
    ],
)
def test_wrong_overrides_name_the_key_and_the_legal_values(override, message):
    with pytest.raises(ConfigError, match=message):
        compose([override])


def test_overrides_must_be_a_list():
    with pytest.raises(ConfigError, match="expected a list"):
        compose("experiment=demo")


def test_the_configuration_is_frozen_and_plain():
    config = compose()
    with pytest.raises(ValueError, match="frozen"):
        config.seed = 3
    assert yaml.safe_load(yaml.safe_dump(config.model_dump(mode="json")))["run"] == "demo"


def test_the_tree_is_the_repositorys():
    assert config_folder() == REPOSITORY / "config"


@pytest.mark.parametrize("experiment", ["smoke", "paper", "demo"])
def test_what_an_experiment_says_of_a_member_that_is_not_chosen_does_not_count(experiment):
    config = compose([f"experiment={experiment}", "skeleton=[ms3d,dpc]", "surface=[alpha_shape]"])
    assert config.methods.names == ["dpc"]
    assert config.surface.names == ["alpha_shape"]
