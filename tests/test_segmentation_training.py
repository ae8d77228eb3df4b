import dataclasses
import logging

import numpy as np
import pytest
import torch
from tiny_clouds import same_weights, select
from tiny_parts import NAMES, PART_CLASSES, TINY, every, labelled, tiny_parts

from morphoskel.datasets.cloud_set import write_cloud_set
from morphoskel.errors import ConfigError, InputError
from morphoskel.learning.hold_out import hold_out
from morphoskel.learning.segmentation_training import train_segmentation_on_files
from morphoskel.learning.train_segmentation import train_segmentation
from morphoskel.networks.part_segmentation import load_segmentation
from morphoskel.sampling.choice import COMPLETED, DRAWN, Choice, write_choice
from morphoskel.sampling.choose_for_split import choose_for_split, read_choices
from morphoskel.sampling.labelled_points import labelled_mask
from morphoskel.seeds import derive_seed

CLOUDS, OTHERS = tiny_parts(shapes=8, repeated=4), tiny_parts(shapes=6, seed=1)
"""Of two files of clouds; those of the first repeat four points."""


@pytest.fixture(autouse=True, scope="module")
def one_thread():
    """Keep the tiny tensors of these tests from waiting for several threads."""
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


def choose(folder, sampler, file="clouds"):
    """Choose points of a file of clouds without training."""
    choose_for_split(
        sampler, folder / f"{file}.npz", folder / sampler / file, networks=[], priors=None, ratios=(5, 8), draws=4,
        seed=3, prior={}, lfs=None,
    )  # fmt: skip


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("segmentation")
    for file, clouds in (("clouds", CLOUDS), ("others", OTHERS)):
        write_cloud_set(clouds, folder / f"{file}.npz")
        for sampler in ("fps", "random"):
            choose(folder, sampler, file)
    train(folder, "fps")
    return folder


def train(folder, result, sampler="fps", ratio=5, number=0, clouds=("clouds",), changes=(), validation=None, **others):
    """Train on clouds and points in the folder, with the validation clouds named, and return the file."""
    values = {
        "strategy": sampler or "full",
        "samples": [folder / sampler / file for file in clouds] if sampler else [],
        "validation_clouds": folder / f"{validation}.npz" if validation else None,
        "validation_samples": folder / sampler / validation if validation and sampler else None,
        "validation_share": 0.25,
        "validation_labels": "labelled",
        "completed": False,
        "label_sets": 1,
        "full_supervision": {},
        "seed": 3,
        **others,
    }
    train_segmentation_on_files(
        ratio=ratio, number=number, clouds=[folder / f"{file}.npz" for file in clouds],
        result=folder / f"{result}.pt", checkpoints=folder / "checkpoints", settings={**LISTS, **dict(changes)},
        accelerator="cpu", **values,
    )  # fmt: skip
    return folder / f"{result}.pt"


LISTS = {name: list(value) if isinstance(value, tuple) else value for name, value in TINY.as_mapping().items()}
"""The settings as a configuration file has them."""


def train_on_arrays(folder, training, validation, sampler="fps", ratio=5, number=0):
    return train_segmentation(
        training, validation, NAMES, PART_CLASSES, TINY, folder, derive_seed(3, "segmentation", str(number)),
        origin={"strategy": sampler, "ratio": ratio, "number": number}, accelerator="cpu", progress=False,
    )  # fmt: skip


def chosen(folder, sampler, draws=(0,), file="clouds", ratio=5):
    """Return the masks of draws, in the order of the file's clouds."""
    clouds = {"clouds": CLOUDS, "others": OTHERS}[file]
    choices = read_choices(folder / sampler / file)[ratio, 0, "fixed" if sampler == "fps" else "drawn"]
    return [labelled_mask(choices.indices[draw], clouds.lengths, 40) for draw in draws]


def held_out(clouds, *masks, share=0.25, seed=3):
    """Return the tensors of the shapes to train on and of those held out."""
    parts = hold_out(clouds.categories.tolist(), share, seed)
    return [labelled(select(clouds, part), *(mask[part] for mask in masks)) for part in parts]


def trainings(folder):
    return sorted(path.name for path in (folder / "checkpoints").iterdir())


def test_the_file_tells_what_it_was_trained_for(files):
    network = load_segmentation(files / "fps.pt")
    assert (network.class_names, network.part_classes) == (NAMES, PART_CLASSES)
    assert network.settings == TINY
    assert network.origin == {"strategy": "fps", "ratio": 5, "number": 0}


def test_the_network_is_that_of_training_on_arrays(files, tmp_path):
    data = held_out(CLOUDS, *chosen(files, "fps"))
    assert all(1 <= count <= 8 for count in data[0].labelled.sum(dim=2).ravel())  # the budget of 40 / 5 labels
    assert same_weights(files / "fps.pt", train_on_arrays(tmp_path, *data))


def test_every_training_of_a_random_sampler_has_draws_of_its_own(files, tmp_path):
    found = train(files, "random", "random", number=1, label_sets=2)
    data = held_out(CLOUDS, *chosen(files, "random", draws=(2, 3)))
    assert same_weights(found, train_on_arrays(tmp_path, *data, sampler="random", number=1))
    with pytest.raises(InputError, match=r"random/clouds: expected at least 6 draws at ratio 5"):
        train(files, "none", "random", number=2, label_sets=2)


def epochs(path):
    settings = load_segmentation(path).settings
    return settings.epochs, settings.decay_epochs


def test_the_training_with_all_labels_alone_can_last_longer(files):
    usual = TINY.epochs, TINY.decay_epochs
    longer = {"epochs": 3 * TINY.epochs, "decay_epochs": None}
    assert epochs(train(files, "full", sampler=None, full_supervision=longer)) == (3 * usual[0], usual[1])
    assert epochs(train(files, "few", "random", full_supervision=longer)) == usual


def test_several_files_are_one_training_set(files, tmp_path):
    found = train(files, "both", clouds=("clouds", "others"))
    both = dataclasses.replace(
        CLOUDS,
        **{
            name: np.concatenate([getattr(clouds, name) for clouds in (CLOUDS, OTHERS)])
            for name in ("ids", "labels", "points", "centres", "scales", "parts")
        },
    )
    mask = np.concatenate([chosen(files, "fps", file=file)[0] for file in ("clouds", "others")])
    assert same_weights(found, train_on_arrays(tmp_path, *held_out(both, mask)))


def test_validation_clouds_choose_the_epoch_by_their_labelled_points_or_by_all(files, tmp_path):
    training = labelled(CLOUDS, *chosen(files, "fps"))
    validation = labelled(OTHERS, *chosen(files, "fps", file="others"))
    found = train(files, "validated", validation="others")
    assert same_weights(found, train_on_arrays(tmp_path / "labelled", training, validation))
    found = train(files, "all", validation="others", validation_labels="all", validation_samples=None)
    assert same_weights(found, train_on_arrays(tmp_path / "all", training, labelled(OTHERS)))
    tables = [path / "segmentation.csv" for path in (tmp_path / "labelled", tmp_path / "all")]
    assert len({table.read_text().splitlines()[1].split(",")[2] for table in tables}) == 2


def test_held_out_shapes_may_show_all_their_labels(files, tmp_path):
    found = train(files, "shown", validation_labels="all")
    data = held_out(CLOUDS, *chosen(files, "fps"))[0], held_out(CLOUDS)[1]
    assert same_weights(found, train_on_arrays(tmp_path, *data))


def test_without_samples_all_points_are_labelled(files, tmp_path):
    found = train(files, "full", sampler=None, ratio=1)
    data = held_out(CLOUDS)
    assert data[0].labelled.sum(dim=2).unique().tolist() == [36]  # repeated points have no label
    assert same_weights(found, train_on_arrays(tmp_path, *data, sampler="full", ratio=1))


def test_shapes_of_which_nothing_was_chosen_are_left_out_and_counted(files, tmp_path, caplog):
    fixed = read_choices(files / "fps" / "clouds")[5, 0, "fixed"]
    indices = fixed.indices.copy()
    parts = hold_out(CLOUDS.categories.tolist(), 0.25, 3)
    gone = [parts[0][1], parts[1][0]]
    indices[:, gone] = -1
    write_cloud_set(CLOUDS, tmp_path / "clouds.npz")
    write_choice(Choice(indices, fixed.distinct), tmp_path / "fps" / "clouds" / "5_0_fixed.npz")
    with caplog.at_level(logging.INFO, logger="morphoskel"):
        found = train(tmp_path, "result")
    assert "fps, ratio 5, training: nothing was chosen of 1 of 6 shapes; left out" in caplog.text
    assert "fps, ratio 5, validation: nothing was chosen of 1 of 2 shapes; left out" in caplog.text
    kept = [np.setdiff1d(part, gone, assume_unique=True) for part in parts]
    (mask,) = chosen(files, "fps")
    data = [labelled(select(CLOUDS, part), mask[part]) for part in kept]
    assert same_weights(found, train_on_arrays(tmp_path / "arrays", *data))


def test_completed_choices_are_taken_if_wanted(files, tmp_path):
    write_cloud_set(CLOUDS, tmp_path / "clouds.npz")
    folder = tmp_path / "ms3d" / "clouds"
    for kind, start in ((DRAWN, 0), (COMPLETED, 1)):
        indices = np.broadcast_to(np.arange(start, 40, 8, dtype=np.int32), (1, 8, 5))
        write_choice(Choice(indices, np.full((1, 8), 5, np.int32)), folder / f"8_1_{kind}.npz")
    for completed, start in ((False, 0), (True, 1)):
        found = train(tmp_path, f"result{start}", "ms3d", ratio=8, completed=completed)
        data = held_out(CLOUDS, every(8, CLOUDS, start))
        assert same_weights(found, train_on_arrays(tmp_path / str(start), *data, sampler="ms3d", ratio=8))


def test_trainings_with_the_same_number_start_alike_whatever_was_labelled(files):
    """The paired comparison of strategies needs the same initial weights and order of the shapes.

    At this learning rate the weights stay the initial ones, and the running statistics tell which shapes were seen.
    """
    still = {"learning_rate": 1e-30, "lowest_learning_rate": 0.0, "epochs": 1, "batch_size": 2}
    cases = {
        "first": {},
        "other strategy": {"sampler": "random"},
        "other ratio": {"ratio": 8},
        "other number": {"number": 1},
    }
    paths = [train(files, name, changes=still, **case) for name, case in cases.items()]
    first, strategy, ratio, number = (torch.load(path, weights_only=True)["weights"] for path in paths)
    for name, values in first.items():
        assert torch.allclose(values, strategy[name], atol=1e-20)
        assert torch.allclose(values, ratio[name], atol=1e-20)
    assert not torch.equal(first["head.first.weight"], number["head.first.weight"])


def test_a_finished_training_gives_its_file_again_without_training(files, monkeypatch):
    before = trainings(files)
    monkeypatch.setattr("morphoskel.learning.train_segmentation.resumable_fit", None)  # cannot be called
    assert train(files, "again").read_bytes() == (files / "fps.pt").read_bytes()
    assert trainings(files) == before
    assert not list(files.glob("*.partial"))


def test_other_settings_seeds_labels_and_clouds_are_trainings_of_their_own(files):
    other = dataclasses.replace(CLOUDS, points=np.ascontiguousarray(CLOUDS.points[..., ::-1]))
    write_cloud_set(other, files / "turned.npz")
    choose(files, "fps", "turned")
    before = len(trainings(files))
    changes = [
        {"ratio": 8, "changes": {"penalty": 0.5}},
        {"changes": {"penalty": 0.5}},
        {"seed": 4},
        {"validation_share": 0.5},
        {"clouds": ("turned",)},
    ]
    for number, change in enumerate(changes, start=1):
        changed = train(files, f"changed{number}", **change)
        assert len(trainings(files)) == before + number
        assert not same_weights(changed, files / "fps.pt")
    assert train(files, "back").read_bytes() == (files / "fps.pt").read_bytes()


def test_bad_input_is_refused(files, tmp_path):
    bare = dataclasses.replace(OTHERS, parts=None, part_classes=None)
    renamed = dataclasses.replace(OTHERS, class_names=np.array(["ball", "rod"]))
    for name, clouds in (("bare", bare), ("renamed", renamed), ("larger", tiny_parts(6, points=50))):
        write_cloud_set(clouds, files / f"{name}.npz")
    other_set = r"npz: expected the categories, parts and number of points of .*clouds\.npz"
    cases = [
        ({"clouds": ("absent",)}, r"absent\.npz: expected a file of clouds"),
        ({"clouds": ("bare",), "sampler": None}, r"bare\.npz: its clouds have no parts"),
        ({"clouds": ("clouds", "renamed"), "sampler": None}, rf"renamed\.{other_set}"),
        ({"validation": "renamed", "sampler": None}, rf"renamed\.{other_set}"),
        ({"validation": "larger", "sampler": None}, rf"larger\.{other_set}"),
        ({"clouds": ("clouds", "others"), "samples": [files / "fps" / "clouds"]}, "each of 2 files, got 1"),
        ({"samples": [files / "fps" / "others"]}, "others: not chosen of the clouds in .* of 6 shapes"),
        ({"validation": "others", "validation_samples": None}, r"others\.npz: expected a folder with the points"),
        ({"ratio": 7}, "fps/clouds: holds no points chosen at ratio 7"),
        ({"samples": [tmp_path / "absent"]}, "absent: holds no chosen points"),
    ]  # fmt: skip
    before = trainings(files)
    for case, message in cases:
        with pytest.raises(InputError, match=message):
            train(files, "none", **case)
    with pytest.raises(ConfigError, match="epochs: expected at least 1"):
        train(files, "none", changes={"epochs": 0})
    assert not (files / "none.pt").exists()
    assert trainings(files) == before
