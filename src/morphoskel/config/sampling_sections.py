"""Configuration sections of the sampling experiments."""

from typing import Annotated, Any, Literal

from pydantic import Field, PositiveInt, model_validator

from morphoskel.config.sections import Section, section_of
from morphoskel.networks.classifier_settings import ClassifierSettings
from morphoskel.networks.generator_settings import GeneratorSettings
from morphoskel.networks.segmentation_settings import SegmentationSettings
from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings
from morphoskel.sampling.lfs import LfsSettings
from morphoskel.sampling.prior import PriorSettings

Generator: Any = section_of(GeneratorSettings)
SkeletonSampler: Any = section_of(SkeletonSamplerSettings)
SkeletonAware: Any = section_of(SkeletonAwareSettings)
Prior: Any = section_of(PriorSettings)
Lfs: Any = section_of(LfsSettings)
Classifier: Any = section_of(ClassifierSettings)
Segmenter: Any = section_of(SegmentationSettings)

Strategy = Literal[
    "random", "fps", "lfs", "snet", "samplenet", "metasampler",
    "skeleton_aware", "ms3d", "dpc", "l1_medial", "uniform", "shuffled",
]  # fmt: skip


class Sampling(Section):
    """What all samplers have in common."""

    points: Annotated[int, Field(ge=2)] = Field(description="points of the clouds that are sampled")
    ratios: tuple[PositiveInt, ...] = Field(min_length=1, description="points of the cloud for each point chosen")
    seeds: PositiveInt = Field(description="trainings of each learned sampler at each ratio")
    draws: PositiveInt = Field(description="choices that a random sampler makes of each test cloud")
    steps: PositiveInt | None = Field(
        description="steps that every learned sampler is trained for, instead of its own number of epochs; "
        "null: as long as its epochs say"
    )
    validation_share: Annotated[float, Field(gt=0, lt=1)] = Field(
        description="share of the training shapes of each class held out to choose the epoch of all networks"
    )
    skeleton: Literal["ms3d", "ms3d_coverage"] = Field(description="MS3D's skeleton for its prior")
    surface: str = Field(description="the surface reconstruction that it is computed from")
    prior: Prior = Field(description="how distances to a skeleton become weights")
    network: SkeletonSampler = Field(description="the skeleton-aware sampler, the same for every prior")

    @model_validator(mode="after")
    def check_ratios(self) -> "Sampling":
        """Refuse ratios that leave no point, and those given twice."""
        if max(self.ratios) > self.points or len(set(self.ratios)) != len(self.ratios):
            raise ValueError(f"ratios: expected different numbers of at most {self.points}, the points of a cloud")
        return self


class Chosen(Section):
    """A sampler without settings of its own."""


class LearnedSkeleton(Section):
    """The skeleton-aware sampler with its own skeleton."""

    skeleton: SkeletonAware = Field(description="the network that predicts the skeleton")


class Samplers(Section):
    """The samplers to run."""

    random: Chosen | None = Field(default=None, description="random points")
    fps: Chosen | None = Field(default=None, description="farthest points, starting with the first")
    lfs: Lfs | None = Field(default=None, description="farthest points weighted by the local feature size of MS3D")
    snet: Generator | None = Field(default=None, description="S-NET")
    samplenet: Generator | None = Field(default=None, description="SampleNet")
    metasampler: Generator | None = Field(default=None, description="Meta-Sampler, joint training")
    skeleton_aware: LearnedSkeleton | None = Field(default=None, description="skeleton-aware sampling")
    ms3d: Chosen | None = Field(default=None, description="skeleton-aware sampling, prior of MS3D")
    dpc: Chosen | None = Field(default=None, description="skeleton-aware sampling, prior of DPC")
    l1_medial: Chosen | None = Field(default=None, description="skeleton-aware sampling, prior of L1")
    uniform: Chosen | None = Field(default=None, description="skeleton-aware sampling, all weights 1")
    shuffled: Chosen | None = Field(default=None, description="skeleton-aware sampling, MS3D's weights shuffled")

    @property
    def names(self) -> list[str]:
        """Names of the samplers that are configured."""
        return [name for name in type(self).model_fields if getattr(self, name) is not None]


class Classification(Section):
    """The classifiers that judge samples."""

    classifier: Classifier = Field(description="the task network")
    plain: Classifier = Field(description="its twin without point dropout")
    teachers: PositiveInt = Field(description="further task networks that train Meta-Sampler; the first one tests it")


class PartSkeletons(Section):
    """What differs for the skeletons of a second data set's shapes."""

    candidates: Annotated[int, Field(ge=100)] | None = Field(
        description="candidates of a shape; null: as skeleton.candidates.count says"
    )
    resolution: Annotated[int, Field(ge=100)] | None = Field(
        description="leaves of the octree of the closed surface; null: as watertight.resolution says"
    )
    depth: Annotated[int, Field(ge=2, le=12)] | None = Field(
        description="octree depth of sampling.surface, if that is a Poisson reconstruction; null: as its section says"
    )


class FullSupervision(Section):
    """What differs for the training with all labels, which has more to learn from; null: as for the others."""

    epochs: PositiveInt | None = Field(description="passes over the training clouds")
    decay_epochs: PositiveInt | None = Field(description="epochs between decays of the learning rate")
    training_points: PositiveInt | None = Field(description="points of a cloud that enter a step")


class Segmentation(Section):
    """Part segmentation from few labels."""

    strategies: tuple[Strategy, ...] = Field(
        min_length=1, description="samplers that choose the labelled points; all labels are always run beside"
    )
    points: Annotated[int, Field(ge=2)] = Field(description="points of the clouds that are segmented")
    ratios: tuple[Annotated[int, Field(ge=2)], ...] = Field(
        min_length=1, description="points of the cloud for each one with a label"
    )
    seeds: PositiveInt = Field(description="trainings of each row")
    training: Literal["train", "trainval"] = Field(
        description="train: the split val chooses the epoch, if there is one; trainval: trains on it, too"
    )
    validation_share: Annotated[float, Field(gt=0, lt=1)] = Field(
        description="share of the training shapes of each class held out to choose the epoch where no split does"
    )
    validation_labels: Literal["labelled", "all"] = Field(
        description="labels that choose the epoch: of the labelled points alone, or of all points"
    )
    label_sets: PositiveInt = Field(
        description="choices of labelled points of a shape; 1: chosen once, as a budget of labels asks for; more: the "
        "epochs take turns, and more labels are seen"
    )
    completed: bool = Field(
        description="whether farthest points take the place of points that a sampler chose twice; only so has every "
        "shape as many labels as the ratio says"
    )
    full_supervision: FullSupervision = Field(description="what differs for the training with all labels")
    skeletons: PartSkeletons = Field(
        description="of the shapes of a second data set, which the strategies lfs and ms3d need"
    )
    network: Segmenter = Field(description="the network and its training")

    @model_validator(mode="after")
    def check_ratios(self) -> "Segmentation":
        """Refuse ratios that leave no point, and names given twice."""
        if max(self.ratios) > self.points or len(set(self.ratios)) != len(self.ratios):
            raise ValueError(f"ratios: expected different numbers of at most {self.points}, the points of a cloud")
        if len(set(self.strategies)) != len(self.strategies):
            raise ValueError(f"strategies: expected different samplers, got {', '.join(self.strategies)}")
        return self


class Tasks(Section):
    """The tasks to learn."""

    classification: Classification | None = Field(default=None, description="classification and retrieval")
    segmentation: Segmentation | None = Field(default=None, description="part segmentation from few labels")
