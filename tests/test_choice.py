import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.sampling.choice import Choice, read_choice, write_choice

CHOICE = Choice(
    np.array([[[4, 0, 4], [-1, -1, -1]], [[1, 2, 3], [-1, -1, -1]]], dtype=np.int32),
    np.array([[2, 0], [3, 0]], dtype=np.int32),
)


def test_a_file_gives_the_choice_back(tmp_path):
    write_choice(CHOICE, tmp_path / "sub" / "choice.npz")
    again = read_choice(tmp_path / "sub" / "choice.npz")
    for name in ("indices", "distinct"):
        assert getattr(again, name).dtype == np.int32
        assert np.array_equal(getattr(again, name), getattr(CHOICE, name))
    assert [path.name for path in (tmp_path / "sub").iterdir()] == ["choice.npz"]


def test_other_files_are_refused(tmp_path):
    (tmp_path / "empty.npz").touch()
    (tmp_path / "text.npz").write_text("0 1 2")
    np.save(tmp_path / "array.npy", CHOICE.indices)
    np.savez(tmp_path / "others.npz", indices=CHOICE.indices)
    generator = np.random.default_rng(0)
    many = Choice(generator.integers(0, 1000, (2, 50, 30), dtype=np.int32), CHOICE.distinct)
    write_choice(many, tmp_path / "damaged.npz")
    content = bytearray((tmp_path / "damaged.npz").read_bytes())
    content[1000:1100] = bytes(100)
    (tmp_path / "damaged.npz").write_bytes(content)
    for name in ("absent.npz", "empty.npz", "text.npz", "array.npy", "others.npz", "damaged.npz"):
        with pytest.raises(InputError, match=rf"{name}: expected a file of chosen points \(.*make it again"):
            read_choice(tmp_path / name)
