import logging
import os

import pytest

from morphoskel.native_output import LOGGED_LINES, native_output_logged


def test_output_past_python_is_logged_and_the_descriptors_come_back(capfd, caplog):
    with caplog.at_level(logging.INFO), native_output_logged("poisson"):
        os.write(1, b"to output\n")
        os.write(2, b"\nto error\n" * 50)
    os.write(1, b"after\n")
    assert capfd.readouterr().out == "after\n"
    assert caplog.messages[:2] == ["poisson: to output", "poisson: to error"]
    assert len(caplog.messages) == LOGGED_LINES


def test_descriptors_come_back_after_an_error(capfd):
    with pytest.raises(ValueError, match="inside"), native_output_logged("poisson"):
        raise ValueError("inside")
    os.write(2, b"after\n")
    assert capfd.readouterr().err == "after\n"
