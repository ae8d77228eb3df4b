import pytest
from hydra.core.override_parser.overrides_parser import OverridesParser

from morphoskel.config import compose
from morphoskel.config.quoted_paths import quote_paths
from morphoskel.errors import ConfigError

ODD_NAMES = [
    "two words", "it's", "it\\'s", "'", '"quoted" words', "a,b", "[a]", "(a)", "a=b", "a:b", "$HOME", "$(touch evil)",
    "`touch evil`", "a;b", "a&b|c", "*?", "~/a", "-rf", "Möbel", "椅子", "tab\tstop", "back\\", "two\\\\", "2024",
    "1e3", "true", "null.", "%s", "#a", "a  b", " a ",
]  # fmt: skip


@pytest.mark.parametrize("name", ODD_NAMES)
def test_a_path_means_what_it_says(name):
    [override] = quote_paths([f"dataset.root={name}"])
    assert OverridesParser.create().parse_override(override).value() == name


def test_paths_of_all_sections():
    assert compose(["dataset=folder", "dataset.root=it's, Möbel"]).dataset.root.as_posix() == "it's, Möbel"
    assert compose(["medial_axis.folder=my axes"]).medial_axis.folder.as_posix() == "my axes"
    assert compose(["methods.point2skeleton.trained=Netz ü.pt"]).methods.point2skeleton.trained.name == "Netz ü.pt"


@pytest.mark.parametrize(
    "text", ["dataset.root='my scans'", 'dataset.root="it\'s"', "dataset.root=/a/b", "dataset.root=${run}/a",
             "medial_axis.folder=null", "skeleton.k=30", "skeleton=[ms3d,dpc]", "~parts", "run=a b", "dataset.root="]
)  # fmt: skip
def test_what_hydra_reads_rightly_stays(text):
    assert quote_paths([text]) == [text]


def test_only_paths_are_taken_literally():
    with pytest.raises(ConfigError, match="run"):
        compose(["run=my run"])
