"""Configuration sections of the data sets."""

from typing import Annotated, Literal

from pydantic import Field, PositiveInt

from morphoskel.config.sections import Section
from morphoskel.config.workflow_path import WorkflowPath
from morphoskel.datasets.address import Address

NAME_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9_.-]*$"
Name = Annotated[str, Field(pattern=NAME_PATTERN)]
Axis = Literal["x", "y", "z", "-x", "-y", "-z"]


class SyntheticDataset(Section):
    """The embedded data set."""

    kind: Literal["synthetic"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder that the shapes are written to")
    categories: tuple[str, ...] | None = Field(description="categories to make; null: all 17")
    per_category: dict[Name, PositiveInt] = Field(description="shapes a category, for each split")
    points: Annotated[int, Field(ge=4)] = Field(description="points a cloud")


class Point2SkeletonDataset(Section):
    """The ShapeNet subset of Point2Skeleton."""

    kind: Literal["point2skeleton"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder with pointclouds/ and data-split/")
    categories: tuple[str, ...] | None = Field(description="categories to use; null: all")
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")


class ModelNet40Dataset(Section):
    """ModelNet40, normal_resampled."""

    kind: Literal["modelnet40"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder with modelnet40_train.txt and one folder a class")
    categories: tuple[str, ...] | None = Field(description="classes to use; null: all")
    points: Annotated[int, Field(ge=4)] | None = Field(description="read the first so many points; null: all")
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")
    url: Address | None = Field(description="address of the public archive, or null")
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = Field(description="checksum of the archive")


class ShapeNetPartDataset(Section):
    """ShapeNetPart in either published layout."""

    kind: Literal["shapenetpart"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder with synsetoffset2category.txt and one folder a category")
    categories: tuple[str, ...] | None = Field(description="categories to use; null: all")
    allow_missing: bool = Field(description="leave out, and count, listed shapes that the folder lacks")
    axes: tuple[Axis, Axis, Axis] = Field(
        description="which axes of the files become x, y and z, turned round by a minus; so that shapes stand like "
        "those that samplers were trained on"
    )
    counts: dict[str, PositiveInt] = Field(description="published number of shapes of each split, for planning")
    url: Address | None = Field(description="address of the public archive, or null")
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = Field(description="checksum of the archive")


class ClassTreeDataset(Section):
    """A tree of classes, splits and files."""

    kind: Literal["class_tree"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder with <class>/{train,test}/<file>")
    categories: tuple[str, ...] | None = Field(description="classes to use; null: all")
    points: Annotated[int, Field(ge=4)] = Field(description="points sampled on each mesh")


class FolderDataset(Section):
    """A user's own files."""

    kind: Literal["folder"]
    name: Name = Field(description="names the data set's folders and its rows in the tables")
    root: WorkflowPath = Field(description="folder with clouds or meshes")
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
