import re

import pytest

from morphoskel.config import compose
from morphoskel.reporting.segmentation_decisions import describe_decisions

TASK = compose().model_dump(mode="json")["tasks"]["segmentation"]


def describe(splits=(["train"], "val"), axes=None, **changes):
    network = {**TASK["network"], **{name: value for name, value in changes.items() if name in TASK["network"]}}
    others = {name: value for name, value in changes.items() if name not in network}
    return " ".join(describe_decisions({**TASK, **others, "network": network}, splits, axes))


def test_every_sentence_is_whole():
    for sentence in describe_decisions(TASK, (["train"], None), ["x", "y", "z"]):
        assert sentence[0].isupper()
        assert sentence.endswith(".")


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"training_input": "labelled", "training_points": None}, "the labelled points alone enter the network"),
        ({"training_input": "labelled", "training_points": 77}, "labelled points alone, at most 77 a step, enter"),
        ({"training_points": 77}, "77 points of a cloud, three quarters of them with labels"),
        ({"full_supervision": {"epochs": 77, "training_points": None}}, "the row with all labels, with 77 epochs."),
        ({"points": 77}, "on 77 points of each cloud"),
        ({"axes": ["x", "z", "-y"]}, "x, y, z are x, z, -y of the files"),
        ({"label_sets": 4}, "chosen 4 times"),
        ({"completed": True}, "take the place of points that a sampler chose twice"),
        ({"restrict_to_category": False}, "parts of all categories can be predicted"),
        ({"know_category": False}, "is not told the category"),
        ({"splits": (["train", "val"], None)}, "Trained on train and val; .*held out"),
        ({"validation_labels": "all"}, "smallest loss on all points of the shapes of the split val"),
    ],
)
def test_a_changed_setting_changes_one_sentence(changes, text):
    usual, changed = describe(), describe(**changes)
    assert changed != usual
    assert re.search(text, changed)
    assert not re.search(text, usual)
