import numpy as np
import pytest
from solids import sphere_cloud, torus

from morphoskel.errors import InputError
from morphoskel.formats import write_cloud_ply, write_mesh_ply
from morphoskel.formats.read_mesh import read_mesh


def test_a_mesh_comes_back(tmp_path):
    write_mesh_ply(tmp_path / "torus.ply", torus())
    assert np.array_equal(read_mesh(tmp_path / "torus.ply").triangles, torus().triangles)


def test_a_cloud_is_no_mesh(tmp_path):
    write_cloud_ply(tmp_path / "cloud.ply", sphere_cloud(20))
    with pytest.raises(InputError, match=r"cloud\.ply: expected a mesh"):
        read_mesh(tmp_path / "cloud.ply")
