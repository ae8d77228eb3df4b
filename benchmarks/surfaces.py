"""The closed surfaces that are measured: real ones where the extracts of the data sets lie, else synthetic ones."""

import os
from collections import Counter
from pathlib import Path

from morphoskel.config import compose
from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.synthetic.generate import generate_shape
from morphoskel.formats import write_mesh_ply
from morphoskel.formats.read_mesh import read_mesh
from morphoskel.seeds import derive_seed
from morphoskel.surface import reconstruct, watertight

REPOSITORY = Path(__file__).resolve().parents[1]
DATA = Path(os.environ.get("MORPHOSKEL_DATA", REPOSITORY.parent / "shared" / "data"))
SEED = 20250325
CLOUDS = 8


def prepare_surfaces(folder: Path) -> dict[str, Path]:
    """Close one dragon and one cloud a category, write them to `folder` and return the files by name."""
    folder.mkdir(parents=True, exist_ok=True)
    dragon = DATA / "meshes" / "stanford_dragon_res3.ply"
    shapes = {"dragon": read_mesh(dragon)} if dragon.is_file() else {}
    if (DATA / "point2skeleton").is_dir():
        shapes |= _clouds(["dataset=point2skeleton", f"dataset.root={DATA / 'point2skeleton'}"])
    else:
        shapes |= _synthetic()
    files = {}
    for name, mesh in shapes.items():
        files[name] = folder / f"{name}.ply"
        write_mesh_ply(files[name], watertight(mesh, seed=derive_seed(SEED, name, "watertight")))
    return files


def read_clouds(a_category):
    """Yield category and cloud of so many test shapes a category: real ones where they lie, else synthetic ones."""
    if not (DATA / "point2skeleton").is_dir():
        for name in compose().dataset.categories:
            for number in range(a_category):
                yield name, generate_shape(name, f"{name}-held-out-{number}", seed=SEED, points=2000).cloud
        return
    dataset = _open(["dataset=point2skeleton", f"dataset.root={DATA / 'point2skeleton'}"])
    taken = Counter()
    for entry in dataset.list_shapes():
        if entry.split == "test" and taken[entry.category] < a_category:
            taken[entry.category] += 1
            yield entry.category, dataset.load(entry.path)


def _open(overrides):
    return open_configured(compose(overrides).model_dump(mode="json")["dataset"], seed=SEED)


def _clouds(overrides):
    dataset = _open(overrides)
    first = {}
    for entry in dataset.list_shapes():
        first.setdefault(entry.category, entry)
    return {f"{category.lower()}": reconstruct(dataset.load(entry.path)) for category, entry in sorted(first.items())}


def _synthetic():
    categories = compose().dataset.categories[:CLOUDS]
    shapes = {name: generate_shape(name, f"{name}-bench", seed=SEED, points=2000) for name in categories}
    return {name.lower(): reconstruct(shape.cloud) for name, shape in shapes.items()}
