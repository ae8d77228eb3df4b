import json

import pytest
import torch

from morphoskel.errors import InputError
from morphoskel.learning.claim import IDENTITY_FILE, claim


def test_a_folder_is_claimed_once_and_again_by_the_same_training_only(tmp_path):
    folder, tensors = tmp_path / "training", [torch.arange(4.0), torch.ones(2, dtype=torch.int64)]
    claim(folder, {"seed": 1}, tensors)
    claim(folder, {"seed": 1}, [tensor.clone() for tensor in tensors])
    written = json.loads((folder / IDENTITY_FILE).read_text())
    assert written["seed"] == 1
    assert len(written["sha256_of_clouds"]) == 2
    for identity, other in (({"seed": 2}, tensors), ({"seed": 1}, [tensors[0] + 1, tensors[1]])):
        with pytest.raises(InputError, match="other settings, clouds or seed"):
            claim(folder, identity, other)
    assert json.loads((folder / IDENTITY_FILE).read_text()) == written
