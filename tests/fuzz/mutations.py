"""Damage the content of a file, as disks, editors, other programs and wrong guesses do.

The general mutations know nothing of formats but that text holds lines and numbers. Files of NumPy and zip archives
are also damaged inside, behind headers and checksums that stay right, where plain damage would never arrive.
"""

from __future__ import annotations

import ast
import io
import re
import struct
import warnings
import zipfile
from collections.abc import Callable, Sequence
from random import Random

Mutation = Callable[[bytes, Random, Sequence[bytes]], bytes]

NUMBERS = (
    b"0", b"-0", b"1", b"-1", b"2", b"3", b"7", b"255", b"65536", b"2147483648", b"-2147483649", b"4294967295",
    b"1000000000000", b"9223372036854775807", b"9223372036854775808", b"18446744073709551616", b"1" + 400 * b"0",
    5000 * b"7", b"0.5", b"1e999", b"-1e308", b"1e-320", b"1e39", b"nan", b"NaN", b"-inf", b"0x10", b"1_000", b"007",
    b"", b"1,5", b"1.5.2", b"\xd9\xa3", b"\xc2\xb2", b"+4", b"True", b"None", b"null",
)  # fmt: skip
"""Texts in the place of a number: borders of integers and floats, other notations, other alphabets."""

BINARY_NUMBERS = tuple(
    value
    for order in "<>"
    for value in (
        *(struct.pack(f"{order}i", number) for number in (0, 1, -1, 3, 2**31 - 1, -(2**31), 10**9)),
        *(struct.pack(f"{order}q", number) for number in (2**63 - 1, -(2**63), 10**12)),
        *(struct.pack(f"{order}{kind}", number) for kind in "fd" for number in (float("nan"), float("inf"), 1e30)),
    )
)
"""Bytes of a binary number."""

DTYPES = (
    "<f8", ">f8", "<f4", "<f2", "<i8", ">i4", "<u8", "|i1", "|b1", "<c16", "|O", "|S3", "<U5", "<U0", "<M8[s]", "<m8",
    "|V8", [("x", "<f8"), ("y", "<f8")], "nonsense", ["<f8"], None, 8,
)  # fmt: skip
"""Types in the header of a NumPy file."""

SHAPES = (
    (), (0,), (1,), (3,), (-1,), (0, 3), (1, 3), (4, 3), (3, 4), (2, 2, 3), (10**12, 3), (2**62, 8), (2**63, 1),
    (2**32, 2**32), (4, -3), (10**30, 3), ("4", 3), (4.0, 3), (True, 3), None, 12,
)  # fmt: skip
"""Shapes in the header of a NumPy file."""

LARGEST = 1 << 16
"""Bytes of the largest mutant: what is too large to read is not asked here, and small files are read quickly."""

_NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")
_WORD = re.compile(rb"[A-Za-z_][\w.]*")
_NUMPY_MAGIC = b"\x93NUMPY"


def mutate(content: bytes, generator: Random, others: Sequence[bytes]) -> bytes:
    """Return `content` with one to four mutations.

    Parameters
    ----------
    content
        A file, whole or damaged already.
    generator
        Source of randomness.
    others
        Files to take pieces from, at least one.
    """
    for _ in range(generator.choice((1, 1, 1, 2, 2, 3, 4))):
        kinds = _GENERAL
        if content.startswith(b"PK\x03\x04") and generator.random() < 0.6:
            kinds = _OF_ZIP
        elif content.startswith(_NUMPY_MAGIC) and generator.random() < 0.6:
            kinds = _OF_NUMPY
        content = generator.choice(kinds)(content, generator, others)[:LARGEST]
    return content


def _flip_bits(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    damaged = bytearray(content)
    for _ in range(generator.choice((1, 1, 2, 8)) if damaged else 0):
        damaged[generator.randrange(len(damaged))] ^= 1 << generator.randrange(8)
    return bytes(damaged)


def _truncate(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    return content[: generator.randint(0, len(content))]


def _drop(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    start, stop = _slice(content, generator)
    return content[:start] + content[stop:]


def _repeat(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    start, stop = _slice(content, generator)
    return content[:stop] + content[start:stop] * generator.choice((1, 1, 2, 50)) + content[stop:]


def _splice(content: bytes, generator: Random, others: Sequence[bytes]) -> bytes:
    """Go on with the end of another file."""
    other = generator.choice(others)
    return content[: generator.randint(0, len(content))] + other[generator.randint(0, len(other)) :]


def _insert(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    at = generator.randint(0, len(content))
    word = generator.choice((b"\0", b"\n", b" ", b"#", b"//", b"\\\n", b",", b"\xff\xfe", b'"', b"\x1c", b"\x85", b"-"))
    return content[:at] + word + content[at:]


def _replace_number(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    return _replace_match(content, _NUMBER, generator.choice(NUMBERS), generator)


def _replace_word(content: bytes, generator: Random, others: Sequence[bytes]) -> bytes:
    """Put a word of another file in the place of one."""
    words = _WORD.findall(generator.choice(others)[:2000])
    return _replace_match(content, _WORD, generator.choice(words), generator) if words else content


def _overwrite(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    """Write a binary number over what is there."""
    number = generator.choice(BINARY_NUMBERS)
    at = generator.randint(0, max(len(content) - len(number), 0))
    return content[:at] + number + content[at + len(number) :]


def _change_lines(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    """Drop, repeat, empty or exchange a line."""
    lines = content.split(b"\n")
    at, other = generator.randrange(len(lines)), generator.randrange(len(lines))
    match generator.randrange(4):
        case 0:
            del lines[at]
        case 1:
            lines.insert(other, lines[at])
        case 2:
            lines[at] = b""
        case _:
            lines[at], lines[other] = lines[other], lines[at]
    return b"\n".join(lines)


def _change_line_ends(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    return content.replace(b"\n", generator.choice((b"\r\n", b"\r", b"\n\n", b" \n", b"\x0b")))


def _change_encoding(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    if generator.random() < 0.3:
        return b"\xef\xbb\xbf" + content
    return content.decode("latin-1").encode(generator.choice(("utf-16", "utf-8", "utf-32-be")), errors="replace")


def _change_separators(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    return content.replace(*generator.choice(((b" ", b","), (b",", b";"), (b".", b","), (b"\t", b" "), (b" ", b"\t"))))


def _change_numpy_header(content: bytes, generator: Random, _: Sequence[bytes]) -> bytes:
    """Declare another type, shape or order, in a header whose length is right."""
    try:
        (length,) = struct.unpack_from("<H", content, 8)
        header = ast.literal_eval(content[10 : 10 + length].decode("latin-1"))
        kind = generator.choice(("descr", "shape", "shape", "fortran_order", "absent"))
        match kind:
            case "descr":
                header[kind] = generator.choice(DTYPES)
            case "shape":
                header[kind] = generator.choice(SHAPES)
            case "fortran_order":
                header[kind] = generator.choice((True, None, 1))
            case _:
                header.pop(generator.choice(sorted(header)))
    except (struct.error, ValueError, SyntaxError, AttributeError, IndexError, TypeError):
        return content
    text = (repr(header) + "\n").encode("latin-1", errors="replace")
    return _NUMPY_MAGIC + b"\x01\x00" + struct.pack("<H", len(text)) + text + content[10 + length :]


def _change_member(content: bytes, generator: Random, others: Sequence[bytes]) -> bytes:
    """Damage a member of a zip archive, and pack it again with the right checksum."""

    def change(members: list[tuple[str, bytes]]) -> None:
        at = generator.randrange(len(members))
        name, data = members[at]
        kinds = _OF_NUMPY if data.startswith(_NUMPY_MAGIC) and generator.random() < 0.7 else _GENERAL
        members[at] = name, generator.choice(kinds)(data, generator, [data, *others])

    return _repack(content, change, generator)


def _change_members(content: bytes, generator: Random, others: Sequence[bytes]) -> bytes:
    """Drop, repeat, rename or exchange members of a zip archive."""

    def change(members: list[tuple[str, bytes]]) -> None:
        at, other = generator.randrange(len(members)), generator.randrange(len(members))
        match generator.randrange(4):
            case 0:
                del members[at]
            case 1:
                members.append(members[at])
            case 2:
                name = generator.choice((members[other][0], f"../{members[at][0]}", "/x", "", "x" * 300, "a/b.npy"))
                members[at] = name, members[at][1]
            case _:
                first, second = members[at], members[other]
                members[at], members[other] = (first[0], second[1]), (second[0], first[1])

    return _repack(content, change, generator)


def _repack(content: bytes, change: Callable[[list[tuple[str, bytes]]], None], generator: Random) -> bytes:
    """Return a zip archive with other members; as it is if it cannot be opened any more."""
    packed = io.BytesIO()
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = [(name, archive.read(name)[:LARGEST]) for name in archive.namelist()]
        change(members)
        method = generator.choice((zipfile.ZIP_STORED, zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
        with warnings.catch_warnings(), zipfile.ZipFile(packed, "w", method) as archive:
            warnings.filterwarnings("ignore", "Duplicate name")  # also a fault that a reader has to bear
            for name, data in members:
                archive.writestr(zipfile.ZipInfo(name), data, method)
    except Exception:  # whatever damage of an earlier mutation makes zipfile raise
        return content
    return packed.getvalue()


def _replace_match(content: bytes, pattern: re.Pattern[bytes], word: bytes, generator: Random) -> bytes:
    found = list(pattern.finditer(content[:LARGEST]))
    if not found:
        return content
    # Headers come first, and hold what is worth changing.
    chosen = found[min(generator.randrange(len(found)), generator.randrange(len(found)))]
    return content[: chosen.start()] + word + content[chosen.end() :]


def _slice(content: bytes, generator: Random) -> tuple[int, int]:
    start = generator.randint(0, len(content))
    return start, min(start + generator.choice((1, 2, 4, 8, 64)), len(content))


_GENERAL: tuple[Mutation, ...] = (
    _flip_bits, _truncate, _drop, _repeat, _splice, _insert, _replace_number, _replace_number, _replace_number,
    _replace_word, _replace_word, _overwrite, _change_lines, _change_lines, _change_line_ends, _change_encoding,
    _change_separators,
)  # fmt: skip
_OF_NUMPY: tuple[Mutation, ...] = (_change_numpy_header, _change_numpy_header, _overwrite)
_OF_ZIP: tuple[Mutation, ...] = (_change_member, _change_member, _change_members)
