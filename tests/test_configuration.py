import base64

import pytest
import yaml

from morphoskel.errors import InputError
from morphoskel.reporting.page.configuration import read_configuration

TEXT = "run: demo\nseed: 5\ndataset:\n  root: /home/ada/My data\n  name: Möbel\nlist:\n- 1\n- 2.5\n"


def test_all_keys_in_their_order_but_no_absolute_path(tmp_path):
    (tmp_path / "config.yaml").write_text(TEXT, encoding="utf-8")
    found = read_configuration(tmp_path / "config.yaml")
    assert found.text == TEXT.replace("/home/ada", "…")
    assert yaml.safe_load(found.text) == found.values
    assert base64.b64decode(found.address.partition(",")[2]).decode() == found.text


def test_values_are_found_by_their_keys(tmp_path):
    (tmp_path / "config.yaml").write_text(TEXT, encoding="utf-8")
    found = read_configuration(tmp_path / "config.yaml")
    assert found.find("dataset", "name") == "Möbel"
    assert found.find("dataset", "name", "deeper") is None
    assert found.find("absent", "key") is None


@pytest.mark.parametrize("text", ["- a\n", "a: [", ""])
def test_other_files_are_refused(tmp_path, text):
    (tmp_path / "config.yaml").write_text(text)
    with pytest.raises(InputError, match=r"config\.yaml: expected"):
        read_configuration(tmp_path / "config.yaml")
    with pytest.raises(InputError, match=r"absent\.yaml: expected"):
        read_configuration(tmp_path / "absent.yaml")
