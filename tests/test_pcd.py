import struct

import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.pcd import decompress_lzf, parse_pcd

POINTS = np.arange(30, dtype=np.float32).reshape(10, 3) ** 1.5


def header(data, fields="x y z", size="4 4 4", kind="F F F", count="1 1 1", points=10):
    return (
        f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {fields}\nSIZE {size}\nTYPE {kind}\n"
        f"COUNT {count}\nWIDTH {points}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA {data}\n"
    ).encode()


ASCII = header("ascii") + "\n".join(" ".join(map(repr, map(float, row))) for row in POINTS).encode()
BINARY = header("binary") + POINTS.tobytes()


@pytest.mark.parametrize("content", [ASCII, ASCII.replace(b"\n", b"\r\n"), BINARY], ids=["ascii", "windows", "binary"])
def test_points(content):
    cloud = parse_pcd(content)
    np.testing.assert_array_equal(cloud.points, POINTS)
    assert cloud.normals is None


def test_fields_in_any_order_with_padding_normals_and_labels():
    names = "label _ normal_x normal_y normal_z z y x _"
    dtype = [
        ("label", "<u2"),
        ("p", "u1", 3),
        ("n", "<f4", 3),
        ("z", "<f8"),
        ("y", "<f4"),
        ("x", "<f4"),
        ("q", "u1", 2),
    ]
    rows = np.zeros(10, dtype=dtype)
    rows["label"], rows["n"] = np.arange(10), [0, 3, 0]
    rows["x"], rows["y"], rows["z"] = POINTS.T
    content = header("binary", names, "2 1 4 4 4 8 4 4 1", "U U F F F F F F U", "1 3 1 1 1 1 1 1 2") + rows.tobytes()
    cloud = parse_pcd(content)
    np.testing.assert_array_equal(cloud.points, POINTS)
    np.testing.assert_array_equal(cloud.normals, np.tile([0, 1, 0], (10, 1)))
    np.testing.assert_array_equal(cloud.labels, np.arange(10))


@pytest.mark.parametrize("options", [{}, {"write_ascii": True}, {"compressed": True}], ids=str)
def test_files_of_open3d(tmp_path, options):
    open3d = pytest.importorskip("open3d")
    generator = np.random.default_rng(3)
    points = np.repeat(generator.normal(size=(200, 3)), 3, axis=0)  # repeats make the compression work
    normals = points / np.linalg.norm(points, axis=1, keepdims=True)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud.normals = open3d.utility.Vector3dVector(normals)
    path = tmp_path / "cloud.pcd"
    assert open3d.io.write_point_cloud(str(path), cloud, **options)
    content = path.read_bytes()
    read = parse_pcd(content)
    np.testing.assert_allclose(read.points, points, atol=1e-6)
    np.testing.assert_allclose(read.normals, normals, atol=1e-6)
    with pytest.raises(InputError, match=r"truncated|damaged"):
        parse_pcd(content[: len(content) // 2])


def test_every_truncation_of_a_binary_file_is_noticed():
    for length in range(len(BINARY)):
        with pytest.raises(InputError):
            parse_pcd(BINARY[:length])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"OFF\n", "PCD header"),
        (ASCII.rsplit(b"\n", 1)[0], "declares 10 points, but 9 lines follow"),
        (ASCII + b"\n1 2 3\n", "declares 10 points, but 11 lines follow"),
        (BINARY[:-1], "declares 10 points, 120 bytes, but 119 bytes follow.*truncated"),
        (BINARY.replace(b"FIELDS x y z", b"FIELDS x y t"), "expected the fields x, y and z; the file has x, y, t"),
        (BINARY.replace(b"TYPE F F F", b"TYPE F F"), "not legal"),
        (BINARY.replace(b"TYPE F F F", b"TYPE F F Q"), "not legal"),
        (BINARY.replace(b"SIZE 4 4 4", b"SIZE 4 4 5"), "not legal"),
        (BINARY.replace(b"COUNT 1 1 1", b"COUNT 1 1 0"), "not positive"),
        (BINARY.replace(b"POINTS 10", b"POINTS -1"), "not positive"),
        (BINARY.replace(b"SIZE 4 4 4\n", b""), "lacks SIZE"),
        (BINARY.replace(b"DATA binary", b"DATA packed"), "expected ascii, binary or binary_compressed"),
        (header("ascii") + b"nan 0 0\n" * 10, "NaN"),
        (header("binary_compressed") + b"123", "lack their sizes"),
        (header("binary_compressed") + struct.pack("<II", 3, 120) + b"\1ab", "hold 2 instead of 120"),
        (header("binary_compressed") + struct.pack("<II", 3, 3) + b"\xe0\1\1", "damaged"),
    ],
)
def test_damage_is_reported(content, message):
    with pytest.raises(InputError, match=message):
        parse_pcd(content)


def test_lzf_literals_copies_and_overlaps():
    assert decompress_lzf(b"\2abc", 3) == b"abc"
    assert decompress_lzf(b"\2abc\x20\2", 6) == b"abcabc"  # copy 3 from 3 back
    assert decompress_lzf(b"\0a\xe0\3\0", 13) == b"a" * 13  # a long copy of what it writes
    with pytest.raises(InputError):
        decompress_lzf(b"\0a\x20\5", 4)  # from before the beginning


def test_real_clouds(real_data):
    files = sorted((real_data / "modelnet10_clouds").glob("*/test/*.pcd"))[::40]
    assert files
    assert {len(parse_pcd(path.read_bytes())) for path in files} == {1024}
