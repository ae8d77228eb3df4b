import numpy as np
import pytest

from morphoskel.errors import InputError
from morphoskel.reporting.contact_sheet import draw_contact_sheet
from morphoskel.reporting.render import View
from morphoskel.shapes import Mesh, PointCloud

TETRAHEDRON = Mesh(
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
)


def test_meshes_and_clouds_are_drawn(tmp_path):
    from matplotlib.image import imread

    points = np.random.default_rng(0).normal(size=(50, 3))
    path = tmp_path / "sheet.png"
    draw_contact_sheet(
        {
            "Solid": [(TETRAHEDRON, np.array([3, 3, 4, 4]))] * 3,
            "Cloud": [PointCloud(points, labels=np.arange(50) % 4), PointCloud(points)],
        },
        path,
        view=View(pixels=80),
    )
    picture = imread(path)
    assert picture.shape[1] == 240
    assert (picture[..., :3].min(axis=2) < 0.9).mean() > 0.02
    assert [file.name for file in tmp_path.iterdir()] == ["sheet.png"]


def test_an_empty_sheet_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_contact_sheet({"Chair": []}, tmp_path / "sheet.png")
