"""Configuration sections of the surface reconstructions."""

from typing import Annotated, Literal

from pydantic import Field, PositiveFloat, PositiveInt

from morphoskel.config.sections import Section


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


class RepairedPoisson(Section):
    """Screened Poisson reconstruction, mended where it contradicts the cloud."""

    depth: Annotated[int, Field(ge=5, le=12)] = Field(
        description="octree depth, 5 to 12; Open3D's solver is unreliable below 5"
    )


class Ponq(Section):
    """PoNQ in optimisation mode; null leaves a value to the preset."""

    preset: Literal["sound", "released"] = Field(
        description="sound: a quarter of the points as sites; released: 50,000 sites drawn with replacement"
    )
    sites: PositiveInt | None = Field(description="number of sites")
    with_replacement: bool | None = Field(description="draw the sites with replacement")
    steps: PositiveInt | None = Field(description="steps of Adam")
    learning_rate: PositiveFloat | None = Field(description="of Adam, in half sides of the shape's cube")
    sample_fraction: Annotated[float, Field(gt=0, le=1)] | None = Field(description="share of the points in each step")
    grid: PositiveInt | None = Field(description="cells along the side of the cube")


class Surface(Section):
    """The surface reconstructions to run; each is one value of the `surface` axis."""

    poisson: Poisson | None = Field(default=None, description="screened Poisson reconstruction")
    ball_pivoting: BallPivoting | None = Field(default=None, description="ball pivoting")
    alpha_shape: AlphaShape | None = Field(default=None, description="alpha shape")
    ponq: Ponq | None = Field(default=None, description="PoNQ")
    repaired_poisson: RepairedPoisson | None = Field(default=None, description="Poisson, mended")

    @property
    def names(self) -> list[str]:
        """Names of the reconstructions that are configured."""
        return [name for name in type(self).model_fields if getattr(self, name) is not None]
