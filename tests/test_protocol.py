import pytest

from morphoskel.errors import InputError
from morphoskel.evaluation.protocol import check_protocol


def test_known_protocols_pass():
    assert [check_protocol(name) for name in ("correct", "released")] == ["correct", "released"]


def test_an_unknown_protocol_is_named_with_the_known_ones():
    with pytest.raises(InputError, match=r"correct, released, got 'paper'"):
        check_protocol("paper")
