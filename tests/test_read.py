import io

import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.formats.read import SUPPORTED_SUFFIXES, read_cloud, read_point_cloud, read_shape
from morphoskel.shapes import Mesh, PointCloud

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
TETRAHEDRON = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


@pytest.mark.parametrize("suffix", [".xyz", ".txt", ".pts", ".csv", ".XYZ"])
def test_the_suffix_chooses_the_reader(tmp_path, suffix):
    path = tmp_path / f"cloud{suffix}"
    path.write_text("\n".join(f"{x} {y} {z}" for x, y, z in POINTS))
    cloud = read_shape(path)
    assert isinstance(cloud, PointCloud)
    np.testing.assert_array_equal(cloud.points, POINTS)
    np.testing.assert_array_equal(read_shape(str(path)).points, POINTS)


@pytest.mark.parametrize("suffix", SUPPORTED_SUFFIXES)
@pytest.mark.parametrize("content", [b"", b" \n\n", b"\x89PNG\r\n\x1a\n\0\0\0", b"<html>404</html>"])
def test_what_is_no_shape_is_an_input_error_that_names_the_file(tmp_path, suffix, content):
    path = tmp_path / f"shape{suffix}"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_shape(path)
    assert str(path) in str(caught.value)


@pytest.mark.parametrize("suffix", SUPPORTED_SUFFIXES)
def test_random_bytes_never_raise_anything_else(tmp_path, suffix):
    generator = np.random.default_rng(5)
    starts = [
        b"",
        b"ply\nformat binary_little_endian 1.0\nelement vertex 9\n",
        b"OFF\n",
        b"solid",
        b"\x93NUMPY",
        b"PK\3\4",
    ]
    path = tmp_path / f"shape{suffix}"
    for start in starts:
        for length in (1, 50, 300):
            path.write_bytes(start + generator.bytes(length))
            with pytest.raises(InputError):
                read_shape(path)


def test_missing_files_folders_and_unknown_formats(tmp_path):
    with pytest.raises(InputError, match=r"absent\.ply: cannot be read \(No such file"):
        read_shape(tmp_path / "absent.ply")
    (tmp_path / "folder.ply").mkdir()
    with pytest.raises(InputError, match=r"folder\.ply: cannot be read"):
        read_shape(tmp_path / "folder.ply")
    with pytest.raises(InputError, match=r"unknown format '\.blend'; expected one of \.ply"):
        read_shape(tmp_path / "a.blend")


def test_a_mesh_is_sampled_and_a_cloud_returned_whole(tmp_path):
    mesh = tmp_path / "mesh.off"
    mesh.write_text(TETRAHEDRON)
    assert isinstance(read_shape(mesh), Mesh)
    sampled = read_cloud(mesh, samples=50, generator=np.random.default_rng(1))
    assert len(sampled) == 50
    np.testing.assert_allclose(np.linalg.norm(sampled.normals, axis=1), 1)
    again = read_cloud(mesh, samples=50, generator=np.random.default_rng(1))
    np.testing.assert_array_equal(sampled.points, again.points)

    cloud = tmp_path / "cloud.npy"
    np.save(cloud, POINTS)
    generator = np.random.default_rng(1)
    assert len(read_cloud(cloud, samples=50, generator=generator)) == 4
    assert generator.random() == np.random.default_rng(1).random()  # untouched


def test_sampling_errors_name_the_file(tmp_path):
    flat = tmp_path / "flat.off"
    flat.write_text("OFF\n4 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n3 0 1 2\n")
    with pytest.raises(InputError, match=r"flat\.off: cannot be sampled"):
        read_cloud(flat, samples=50, generator=np.random.default_rng(1))


def test_a_mesh_is_no_point_cloud(tmp_path):
    path = tmp_path / "mesh.off"
    path.write_text(TETRAHEDRON)
    with pytest.raises(InputError, match="found a mesh of 4 triangles"):
        read_point_cloud(path)


def test_meshes_of_another_library(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box((1, 2, 3))
    for suffix in ("ply", "off", "obj", "stl"):
        path = tmp_path / f"box.{suffix}"
        box.export(path)
        mesh = read_shape(path)
        assert isinstance(mesh, Mesh)
        corners = mesh.vertices[mesh.triangles]
        np.testing.assert_allclose(corners, box.vertices[box.faces], atol=1e-6)
    ascii_ply = trimesh.exchange.ply.export_ply(box, encoding="ascii")
    path = tmp_path / "ascii.ply"
    path.write_bytes(ascii_ply)
    np.testing.assert_allclose(read_shape(path).vertices, box.vertices, atol=1e-6)
    path = tmp_path / "ascii.stl"
    path.write_text(trimesh.exchange.stl.export_stl_ascii(box))
    assert len(read_shape(path).triangles) == 12


def test_real_meshes_as_another_library_reads_them(real_data):
    trimesh = pytest.importorskip("trimesh")
    for name in ("medial_axis/dog.off", "meshes/stanford_dragon_res3.ply"):
        mesh = read_shape(real_data / name)
        assert isinstance(mesh, Mesh)
        other = trimesh.load(io.BytesIO((real_data / name).read_bytes()), file_type=name[-3:], process=False)
        np.testing.assert_allclose(mesh.vertices, other.vertices, atol=1e-6)
        np.testing.assert_array_equal(mesh.triangles, other.faces)
