"""Inputs that were handled wrongly once, made as small as they can be."""

from __future__ import annotations

import io
import struct
import zipfile
from dataclasses import dataclass

import numpy as np

HUGE = b"7" * 5000
"""Python refuses to convert numbers of so many digits, with an error of its own."""


@dataclass(frozen=True)
class Regression:
    """A file that its reader must refuse.

    Parameters
    ----------
    reader
        Name in :data:`fuzz.readers.READERS`.
    what
        The fault, as it was.
    content
        The file.
    finding
        What the recorded run called it, if that found it: there it is counted, but it is no fault any more.
    """

    reader: str
    what: str
    content: bytes
    finding: str = ""


def npy(header: bytes, data: bytes = b"") -> bytes:
    """Return an array with any header."""
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header) + 1) + header + b"\n" + data


def declared(shape: str, kind: str = "<f8") -> bytes:
    """Return an array without data."""
    return npy(f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}}}".encode())


def archive(**members: bytes) -> bytes:
    """Return an NPZ file with these members."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as opened:
        for name, data in members.items():
            opened.writestr(zipfile.ZipInfo(f"{name}.npy"), data)
    return packed.getvalue()


def chosen_points(sizes: list[float]) -> bytes:
    """Return chosen points of a cloud of two, with these local feature sizes."""
    arrays = {
        "indices": np.arange(2), "points": np.eye(3)[:2], "cloud": np.eye(3)[:2], "local_feature_size": np.array(sizes),
    }  # fmt: skip
    packed = io.BytesIO()
    np.savez(packed, **arrays)
    return packed.getvalue()


TOO_LARGE = declared("(1000000000000, 3)")
TORN = npy(b"{': '|V8', 'shape': (10000000000")

_ARRAY_FAULTS = {
    "room was made for the 10^12 rows that a header declares": TOO_LARGE,
    "a torn header gave an error of Python's tokenizer": TORN,
    "a shape beyond 64 bits gave a warning": declared("(9223372036854775808, 1)"),
    "a truth value in a shape was a TypeError": npy(
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (True, True, True)}", bytes(8)
    ),
    "an empty array with too many rows was a ValueError": declared("(0, 9223372036854775807)"),
    "a shape beyond 64 bits overflowed": declared("(1000000000000000000000000000000, 3)"),
}

REGRESSIONS: tuple[Regression, ...] = (
    Regression("ply", "a count of thousands of digits", b"ply\nelement vertex " + HUGE + b"\nend_header\n"),
    Regression("skeleton_ply", "a count of thousands of digits", b"ply\nelement vertex " + HUGE + b"\nend_header\n"),
    Regression("off", "a count of thousands of digits", b"OFF " + HUGE + b" 0 0"),
    Regression("obj", "a vertex number beyond 64 bits", b"v 0 0 1\nf 30000000000000000000 1 2"),
    Regression("benchmark", "another encoding", b"\xfe"),
    Regression("pcd", "a field of a billion values a point",
               b"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 933725807\nWIDTH 8\nHEIGHT 0\nDATA binary"),
    Regression("pcd", "a comma for the size of a field made another type",
               b"FIELDS x y z\nSIZE , 4 4\nTYPE F F F\nPOINTS 1\nDATA binary\n" + bytes(8)),
    Regression("pcd", "a size of thousands of digits",
               b"FIELDS x y z\nSIZE ," + HUGE + b" 4 4\nTYPE F F F\nPOINTS 1\nDATA binary\n"),
    Regression("text", "a count of thousands of digits", HUGE),
    Regression("medial_axis_ma", "a count of thousands of digits", HUGE + b" 0 0"),
    Regression("medial_axis_ply", "a count of thousands of digits", b"ply\nelement vertex " + HUGE + b"\nend_header\n"),
    *(Regression("npy", what, content) for what, content in _ARRAY_FAULTS.items()),
    Regression("npy", "imaginary parts were dropped", npy(
        b"{'descr': '<c16', 'fortran_order': False, 'shape': (4, 3)}", bytes(4 * 3 * 16))),
    Regression("npy", "a NaN that signals gave a warning", npy(
        b"{'descr': '<f4', 'fortran_order': False, 'shape': (4, 3)}", b"\0\0\xa0\x7f" * 12)),
    Regression("stl", "a NaN that signals gave a warning",
               bytes(80) + b"\1\0\0\0" + bytes(12) + b"\0\0\xa0\x7f" * 9 + bytes(2)),
    Regression("ply", "a NaN that signals gave a warning",
               b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               b"property float z\nend_header\n" + b"\0\0\xa0\x7f" * 12),
    *(
        Regression(reader, what, archive(**{name: content}))
        for reader, name in (
            ("npz", "points"), ("skeleton_npz", "points"), ("chosen_points", "indices"), ("illustration", "name"),
            ("cloud_set", "ids"), ("prior_set", "ids"), ("choice", "indices"),
        )
        for what, content in _ARRAY_FAULTS.items()
    ),
    Regression("chosen_points", "an infinite local feature size gave a warning", chosen_points([0.1, float("inf")])),
    Regression("chosen_points", "a local feature size that is none: the message named no file",
               chosen_points([float("nan"), 0.1])),
    Regression("illustration", "a member that is no array was taken for one", archive(name=b"pyramid")),
    Regression("manifest", "a shard of thousands of digits",
               b"id,category,split,shard,path,sha256\ns0,Lamp,test," + HUGE + b",a," + b"0" * 64),
    Regression("status", "a file without the columns", b"\ns"),
    Regression("status", "a row with too many fields", b",attempts\ns"),
    Regression("status", "a number that is none", b"seconds_so_far,\nC"),
    Regression("status", "another encoding", b"\xf8"),
    Regression("published_table", "an unknown metric: the message named no file",
               b"table,method,group,metric,value,note\nprocessing_time,a,A,1,,"),
    *(
        Regression(reader, what, content)
        for reader in ("published_table", "result_table", "scaling")
        for what, content in (
            ("another encoding", b"\x85\xf8"), ("an open quotation mark", b'"'), ("an empty table", b""),
        )
    ),
    Regression("result_table", "an infinite number of shapes overflowed",
               b"dataset,method,group,metric,value,std,paper,n,n_failed,seeds,protocol\na,b,c,d,1,,,1e999,0,7,x"),
    Regression("result_rows", "an infinite seed became an arbitrary one",
               b"sampler,ratio,seed,id,category,status,correct\nfps,8,-inf,a,n,ok,1\n"),
    Regression("shapenetpart_list", "a shape listed twice: the message named no file",
               b'["03467517/shape","03467517/shape"]'),
    Regression("shapenetpart_labels", "a label beyond 64 bits", b"18446744073709551616"),
    Regression("shapenetpart_labels", "a label of no part: the message named another file", b"1\n1\n7\n2\n3\n3"),
    Regression("shapenetpart_labels", "a label at the end of 64 bits overflowed",
               b"1\n1\n1\n9223372036854775807\n1\n1"),
    Regression("configuration", "a number in place of all samplers", b"samplers=6",
               "error: TypeError in compose.py, _drop_unchosen"),
    Regression("configuration", "a word in place of all methods", b"methods=abc"),
)  # fmt: skip
