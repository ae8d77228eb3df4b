import argparse
from pathlib import Path

import pytest

from morphoskel.commands.subcommand import add_subcommand, named_files
from morphoskel.errors import InputError


def test_help_is_a_sentence_with_the_examples_as_they_are(capsys):
    parser = argparse.ArgumentParser("program")
    add_subcommand(parser.add_subparsers(), "try", "show what it does", "examples:\n  program try     this\n")
    with pytest.raises(SystemExit):
        parser.parse_args(["try", "--help"])
    text = capsys.readouterr().out
    assert "Show what it does." in text
    assert "  program try     this\n" in text


def test_the_number_of_files_is_checked():
    assert named_files(["a", "b"], "A and B", least=2, most=2) == [Path("a"), Path("b")]
    for words in (["a"], ["a", "b", "c"]):
        with pytest.raises(InputError, match=f"expected A and B, got {len(words)} files: a"):
            named_files(words, "A and B", least=2, most=2)
