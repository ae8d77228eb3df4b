"""Every configuration key: its meaning, unit and legal values.

Unknown keys are refused everywhere. Sections are frozen; a rule receives only the sections that it reads.
"""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, PositiveFloat, PositiveInt

NAME_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9_.-]*$"
Name = Annotated[str, Field(pattern=NAME_PATTERN)]


class Section(BaseModel):
    """Base of all sections."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class SyntheticDataset(Section):
    """The embedded data set."""

    kind: Literal["synthetic"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder that the shapes are written to")
    categories: tuple[str, ...] | None = Field(description="categories to make; null: all 17")
    per_category: dict[Name, PositiveInt] = Field(description="shapes a category, for each split")
    points: Annotated[int, Field(ge=4)] = Field(description="points a cloud")


class Point2SkeletonDataset(Section):
    """The ShapeNet subset of Point2Skeleton."""

    kind: Literal["point2skeleton"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder with pointclouds/ and data-split/")
    categories: tuple[str, ...] | None = Field(description="categories to use; null: all")
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")


class ModelNet40Dataset(Section):
    """ModelNet40, normal_resampled."""

    kind: Literal["modelnet40"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder with modelnet40_train.txt and one folder a class")
    categories: tuple[str, ...] | None = Field(description="classes to use; null: all")
    points: Annotated[int, Field(ge=4)] | None = Field(description="read the first so many points; null: all")
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")
    url: str | None = Field(description="address of the public archive, or null")
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = Field(description="checksum of the archive")


class ShapeNetPartDataset(Section):
    """ShapeNetPart in either published layout."""

    kind: Literal["shapenetpart"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder with synsetoffset2category.txt and one folder a category")
    categories: tuple[str, ...] | None = Field(description="categories to use; null: all")
    allow_missing: bool = Field(description="leave out, and count, listed shapes that the folder lacks")
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")
    url: str | None = Field(description="address of the public archive, or null")
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = Field(description="checksum of the archive")


class ClassTreeDataset(Section):
    """A tree of classes, splits and files."""

    kind: Literal["class_tree"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder with <class>/{train,test}/<file>")
    categories: tuple[str, ...] | None = Field(description="classes to use; null: all")
    points: Annotated[int, Field(ge=4)] = Field(description="points sampled on each mesh")


class FolderDataset(Section):
    """A user's own files."""

    kind: Literal["folder"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: Path = Field(description="folder with clouds or meshes")
    points: Annotated[int, Field(ge=4)] = Field(description="points sampled on each mesh")


Dataset = Annotated[
    SyntheticDataset
    | Point2SkeletonDataset
    | ModelNet40Dataset
    | ShapeNetPartDataset
    | ClassTreeDataset
    | FolderDataset,
    Field(discriminator="kind"),
]


class Poisson(Section):
    """Screened Poisson reconstruction."""

    depth: Annotated[int, Field(ge=5, le=12)] = Field(
        description="octree depth, 5 to 12; Open3D's solver is unreliable below 5"
    )


class BallPivoting(Section):
    """Ball pivoting."""

    radius_factors: tuple[PositiveFloat, ...] = Field(
        min_length=1, description="ball radii in units of the mean nearest-neighbour distance"
    )
    maximum_triangles: PositiveInt = Field(description="larger meshes are decimated to this many triangles")


class AlphaShape(Section):
    """Alpha shape."""

    alpha: PositiveFloat = Field(description="radius of the carving ball, in the unit that `unit` names")
    unit: Literal["radius", "absolute"] = Field(
        description="radius: relative to the cloud's largest distance from its box's centre; absolute: as released"
    )


class Surface(Section):
    """The surface reconstructions to run; each is one value of the `surface` axis."""

    poisson: Poisson | None = Field(default=None, description="screened Poisson reconstruction")
    ball_pivoting: BallPivoting | None = Field(default=None, description="ball pivoting")
    alpha_shape: AlphaShape | None = Field(default=None, description="alpha shape")

    @property
    def names(self) -> list[str]:
        """Names of the reconstructions that are configured."""
        return [name for name in type(self).model_fields if getattr(self, name) is not None]


class Watertight(Section):
    """Conversion of any triangle soup to a closed surface."""

    resolution: Annotated[int, Field(ge=100)] = Field(description="number of octree leaves, at least 100")


class Candidates(Section):
    """Points scattered in the bounding box."""

    mode: Literal["random", "grid"] = Field(description="uniform random, or a regular grid with equal counts an axis")
    count: Annotated[int, Field(ge=8)] = Field(description="number of points in the box before the inside test")


class Skeleton(Section):
    """MorphoSkel3D."""

    candidates: Candidates
    k: Annotated[int, Field(ge=2)] = Field(description="size of the structuring element, the point itself included")
    points: PositiveInt = Field(description="number of maximal balls kept")
    selection: Literal["residue"] = Field(description="rule that picks the maximal balls")


class Evaluation(Section):
    """Which shapes enter the skeleton tables."""

    split: Name = Field(description="split of the data set")


class Timing(Section):
    """The timing table."""

    shapes_per_category: PositiveInt = Field(description="shapes timed in each category")


class Config(Section):
    """One experiment."""

    run: Name = Field(description="name of the experiment; results go to results/{run}")
    seed: Annotated[int, Field(ge=0)] = Field(description="global seed, from which every other is derived")
    protocol: Literal["correct", "released"] = Field(
        description="correct: sound means; released: the published script's two averaging slips"
    )
    shard_size: PositiveInt = Field(description="shapes a job; does not change results")
    cores: PositiveInt = Field(description="cores of a job of the per-shape chain; does not change results")
    threads: PositiveInt = Field(
        description="cores that one shape gets; a job works on cores / threads shapes side by side, "
        "on fewer with more threads where there are fewer; does not change results"
    )
    max_failed: Annotated[int, Field(ge=0)] = Field(
        description="failed shapes tolerated under each surface reconstruction"
    )
    keep_intermediates: bool = Field(
        description="keep occupancy, UDF and dilation: 8 bytes an inner point and a bit a candidate; a change of "
        "skeleton.k then reruns the dilation alone; false deletes them as soon as the skeleton is made"
    )
    dataset: Dataset
    surface: Surface
    watertight: Watertight
    skeleton: Skeleton
    evaluation: Evaluation
    timing: Timing
