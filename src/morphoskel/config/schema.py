"""Every configuration key: its meaning, unit and legal values.

Unknown keys are refused everywhere. Sections are frozen; a rule receives only the sections that it reads.
"""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PositiveFloat, PositiveInt, model_validator

from morphoskel.config.dataset_sections import Dataset, Name
from morphoskel.config.sampling_sections import Samplers, Sampling, Tasks
from morphoskel.config.sections import Section, section_of
from morphoskel.config.surface_sections import Surface
from morphoskel.config.workflow_path import WorkflowPath
from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings
from morphoskel.sampling.samplers import LEARNED
from morphoskel.skeleton.dpc.settings import DeepPointsSettings
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings


class Watertight(Section):
    """Conversion of any triangle soup to a closed surface."""

    resolution: Annotated[int, Field(ge=100)] = Field(description="number of octree leaves, at least 100")


class Candidates(Section):
    """Points scattered in the bounding box."""

    mode: Literal["random", "grid"] = Field(description="uniform random, or a regular grid with equal counts an axis")
    count: Annotated[int, Field(ge=8)] = Field(description="number of points in the box before the inside test")


class Coverage(Section):
    """The coverage selection."""

    nominees: PositiveInt = Field(description="candidates that each point of the cloud nominates")
    touch: PositiveFloat = Field(
        description="largest gap between a ball and the cloud, in mean distances of neighbouring points"
    )


def _as_tuple(value: Any) -> Any:
    return (value,) if isinstance(value, str) else value


class Skeleton(Section):
    """MorphoSkel3D."""

    candidates: Candidates
    k: Annotated[int, Field(ge=2)] = Field(description="size of the structuring element, the point itself included")
    points: PositiveInt = Field(description="number of maximal balls kept")
    selection: Annotated[tuple[Literal["residue", "coverage"], ...], BeforeValidator(_as_tuple)] = Field(
        min_length=1, description="rules that pick the maximal balls; each is a row of the tables"
    )
    coverage: Coverage


class CoverageAxis(Section):
    """Coverage Axis++."""

    points: PositiveInt = Field(description="balls chosen")
    offset: PositiveFloat = Field(description="growth of a ball when it covers points; longest side of the box = 1")
    penalty: Literal["demo", "standardised"] = Field(description="how small balls are penalised")
    candidate_limit: PositiveInt | None = Field(description="inner points used, evenly by index; null: all")
    stop_when_covered: bool = Field(description="stop as soon as all points are covered")


Network: Any = section_of(Point2SkeletonSettings)


class Point2Skeleton(Section):
    """Point2Skeleton."""

    trained: WorkflowPath | None = Field(description="a trained network's file; null: train one on the training split")
    validation_share: Annotated[float, Field(gt=0, lt=1)] = Field(
        description="share of the training shapes held out to choose the epoch"
    )
    dense_balls: PositiveInt = Field(description="balls interpolated on the skeletal mesh")
    refine_radii: bool = Field(description="radii from the distance to the skeletal mesh instead of its points")
    network: Network


L1Medial: Any = section_of(L1MedialSettings)
DeepPoints: Any = section_of(DeepPointsSettings)


class Methods(Section):
    """The skeleton methods to run beside MorphoSkel3D."""

    coverage_axis: CoverageAxis | None = Field(default=None, description="Coverage Axis++")
    l1_medial: L1Medial | None = Field(default=None, description="L1-medial skeleton")
    dpc: DeepPoints | None = Field(default=None, description="deep points consolidation")
    point2skeleton: Point2Skeleton | None = Field(default=None, description="Point2Skeleton")

    @property
    def names(self) -> list[str]:
        """Names of the methods that are configured."""
        return [name for name in type(self).model_fields if getattr(self, name) is not None]


class Evaluation(Section):
    """Which shapes enter the skeleton tables."""

    split: Name = Field(description="split of the data set")
    equal_counts: tuple[PositiveInt, ...] = Field(
        description="numbers of balls to which every skeleton is brought for comparison"
    )


class MedialAxis(Section):
    """The reference medial axis of CD-MAT and HD-MAT."""

    folder: WorkflowPath | None = Field(description="folder with <shape>_mat.ply or <shape>.ma files; null: computed")
    surface: str = Field(description="the surface reconstruction that it is computed from")
    samples: Annotated[int, Field(ge=100)] = Field(description="points on the surface, each with a shrinking ball")
    separation_angle: Annotated[float, Field(ge=0, lt=180)] = Field(
        description="degrees; balls whose two touching points are seen under less are pruned"
    )
    scale: Annotated[float, Field(ge=0)] = Field(
        description="smallest distance of the two touching points, in diagonals of the box"
    )
    tolerance: Annotated[float, Field(ge=0)] = Field(
        description="depth of samples inside a ball that is forgiven, in radii"
    )
    gap: Annotated[float, Field(ge=0)] = Field(description="smallest distance between points of the axis, in diagonals")
    count: PositiveInt = Field(description="points of the axis, at most")


class Trainer(Section):
    """How networks are trained."""

    accelerator: Literal["auto", "cpu", "gpu"] = Field(description="processor or graphics card")
    devices: PositiveInt = Field(description="graphics cards of a training, or processes on a processor")
    threads: PositiveInt = Field(description="threads of the processor; results on a processor depend on it")
    together: bool = Field(
        description="train a sampler, or a row of part segmentation, for all ratios and seeds in one job, one after "
        "the other: saves the start where trainings are short; does not change results"
    )


class Timing(Section):
    """The timing table."""

    shapes_per_category: PositiveInt = Field(description="shapes timed in each category")


class Figures(Section):
    """What the figures show."""

    overview: str = Field(description="dragon: one of our own; or a file with a cloud or a mesh")
    candidates: Annotated[int, Field(ge=1000)] = Field(description="candidates in that shape")
    sparse: Annotated[int, Field(ge=100)] = Field(description="candidates where they are drawn in their box")
    dense: Annotated[int, Field(ge=1000)] = Field(description="candidates of the comparison with more of them")
    rationale: Annotated[int, Field(ge=1000)] = Field(description="candidates in torus and box")
    scaling: tuple[Annotated[int, Field(ge=100)], ...] = Field(
        min_length=2, description="numbers of candidates of the scaling curve"
    )
    repeats: PositiveInt = Field(description="measurements of each number")
    shapes: tuple[str, ...] = Field(
        description="shapes or categories to be drawn first, by parts of their names in lower case"
    )


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
        description="failed shapes tolerated under each method and surface reconstruction"
    )
    keep_intermediates: bool = Field(
        description="keep occupancy, UDF and dilation: 8 bytes an inner point and a bit a candidate; a change of "
        "skeleton.k then reruns the dilation alone; false deletes them as soon as the skeleton is made"
    )
    dataset: Dataset
    parts: Dataset | None = Field(
        default=None,
        description="a second data set, for part segmentation alone; without, the first one's parts are segmented",
    )
    surface: Surface
    watertight: Watertight
    skeleton: Skeleton
    methods: Methods = Methods()
    evaluation: Evaluation
    medial_axis: MedialAxis
    sampling: Sampling
    samplers: Samplers = Samplers()
    tasks: Tasks = Tasks()
    trainer: Trainer
    timing: Timing
    figures: Figures

    @property
    def segmented(self) -> Dataset | None:
        """The data set whose parts are segmented; ``None`` if neither has parts."""
        chosen = self.parts or self.dataset
        return chosen if chosen.kind in ("shapenetpart", "synthetic") else None

    @model_validator(mode="after")
    def check_parts(self) -> "Config":
        """Refuse a second data set that has no parts or the first one's name."""
        if self.parts is not None and self.segmented is None:
            raise ValueError(f"parts: {self.parts.name} has no parts; choose shapenetpart or synthetic_parts")
        if self.parts is not None and self.parts.name == self.dataset.name:
            raise ValueError(
                f"parts: expected a name other than {self.dataset.name}, the first data set's; for its own parts write "
                "~parts"
            )
        return self

    @model_validator(mode="after")
    def check_transfer(self) -> "Config":
        """Refuse to let learned samplers choose other numbers of labelled points than they are trained for."""
        task = self.tasks.segmentation
        learned = [name for name in task.strategies if name in LEARNED and name in self.samplers.names] if task else []
        if not task or not learned or self.segmented is None:
            return self
        trained = {self.sampling.points // ratio for ratio in self.sampling.ratios}
        wanted = [task.points // ratio for ratio in task.ratios]
        if not trained.issuperset(wanted):
            raise ValueError(
                f"tasks.segmentation: {', '.join(learned)} would have to choose {', '.join(map(str, wanted))} points, "
                f"but are trained to choose {', '.join(map(str, sorted(trained, reverse=True)))} (sampling.points / "
                "sampling.ratios); change one of the two, leave learned samplers out of "
                "tasks.segmentation.strategies, or part segmentation out of it all: task=[classification]"
            )
        return self
