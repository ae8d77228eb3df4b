import numpy as np
import pytest
from solids import ball

from morphoskel.chain.status import Status, write_status
from morphoskel.datasets.manifest import ShapeRecord
from morphoskel.errors import InputError
from morphoskel.formats import write_mesh_ply, write_skeleton_ply
from morphoskel.reporting.render import View
from morphoskel.reporting.skeleton_gallery import draw_skeleton_gallery
from morphoskel.shapes import Skeleton


def test_a_gallery_shows_each_category_and_says_what_failed(tmp_path):
    from PIL import Image

    records = [ShapeRecord(name, category, "test", 0, tmp_path, "")
               for name, category in (("a", "Ball"), ("b", "Ball"), ("c", "Broken"))]  # fmt: skip
    write_status(tmp_path, [
        Status("a", "Ball", "ok", "select_skeleton", "", 1, 0.1, 0.2, ""),
        Status("c", "Broken", "failed", "udf", "boom", 2, 0.1, 0.2, ""),
    ])  # fmt: skip
    write_skeleton_ply(tmp_path / "a.ply", Skeleton([[0.0, 0, 0]], [0.5], [0.0]))
    write_mesh_ply(tmp_path / "meshes" / "a.ply", ball(subdivisions=2))
    folders = {"poisson/ms3d": [tmp_path], "cloud/dpc": [tmp_path]}
    meshes = {"poisson": [tmp_path / "meshes"]}
    draw_skeleton_gallery(tmp_path / "gallery.png", records, meshes, folders, view=View(pixels=60))
    with Image.open(tmp_path / "gallery.png") as picture:
        assert 0.8 * picture.height < picture.width < 1.2 * picture.height
        assert len(np.unique(np.asarray(picture.convert("L")))) > 20


def test_an_empty_gallery_is_refused(tmp_path):
    with pytest.raises(InputError, match="at least one shape"):
        draw_skeleton_gallery(tmp_path / "gallery.png", [], {}, {})
