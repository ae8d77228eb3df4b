# What the rules of sampling and learning read: their paths, and the helpers that find them.
from morphoskel.reporting.segmentation_decisions import describe_decisions
from morphoskel.sampling.samplers import (
    GENERATORS,
    LEARNED,
    LEARNED_SKELETON,
    SKELETON_OF,
    TRAINING_FREE,
)

CLOUDS = f"{RESULTS}/clouds/{{dataset}}/{{split}}/{{points}}.npz"
PRIORS = f"{RESULTS}/priors/{{dataset}}/{{split}}/{{points}}/{{skeleton}}.npz"
TRAINED_SAMPLER = (
    f"{RESULTS}/networks/{{dataset}}/sampler/{{sampler}}/{{ratio}}/{{seed}}/network.pt"
)
SAMPLES = f"{RESULTS}/samples/{{dataset}}/{{split}}/{{sampler}}"
JUDGED = f"{RESULTS}/evaluation/{{{{dataset}}}}/{{{{split}}}}/samples/{{{{sampler}}}}_{{level}}.csv"
LABELLED_POINTS = f"{RESULTS}/labelled_points/{{dataset}}/{{split}}/{{sampler}}"
TRAINED_SEGMENTER = f"{RESULTS}/networks/{{dataset}}/segmentation/{{strategy}}/{{ratio}}/{{seed}}/network.pt"
SEGMENTED = f"{RESULTS}/evaluation/{{dataset}}/{{split}}/segmentation/{{strategy}}.csv"

# Clouds as the samplers, and as the networks for parts see them.
SAMPLED_CLOUDS = CLOUDS.replace("{points}", str(CONFIG.sampling.points))
PART_CLOUDS = (
    CLOUDS.replace("{points}", str(CONFIG.tasks.segmentation.points))
    if CONFIG.tasks.segmentation
    else CLOUDS
)

# The strategy that labels every point.
EVERY_LABEL = "full"


def possible_samplers():
    """Return the samplers chosen whose skeletons are made."""
    made = [LEARNED_SKELETON, *CONFIG.methods.names]
    if CONFIG.sampling.surface in CONFIG.surface.names:
        made.append("ms3d")
    return [
        sampler
        for sampler in CONFIG.samplers.names
        if SKELETON_OF.get(sampler, LEARNED_SKELETON) in made
    ]


def samplers():
    """Return the samplers to compare, if there are shapes to learn from."""
    can_learn = SHAPES.get("train", 0) > 1 and CONFIG.tasks.classification
    return possible_samplers() if can_learn else []


def prior_skeletons(wildcards):
    """Return the skeleton folders to which local feature sizes are measured."""
    on_cloud = wildcards.skeleton in CLOUD_METHODS
    return of_shards(
        SKELETONS,
        wildcards.split,
        wildcards.dataset,
        surface=CLOUD if on_cloud else CONFIG.sampling.surface,
        skeleton=wildcards.skeleton if on_cloud else CONFIG.sampling.skeleton,
    )


def priors_on(dataset, split, points, sampler):
    """Return the file of local feature sizes that a sampler needs for clouds of so many points, if it needs one."""
    needed = [SKELETON_OF[sampler]] if sampler in SKELETON_OF else []
    return expand(PRIORS, dataset=dataset, split=split, points=points, skeleton=needed)


def training_priors(wildcards):
    """Return the local feature sizes that a sampler is trained with."""
    return priors_on(
        wildcards.dataset, "train", CONFIG.sampling.points, wildcards.sampler
    )


def sampler_priors(wildcards):
    """Return the local feature sizes of the split that is sampled."""
    return priors_on(
        wildcards.dataset, wildcards.split, CONFIG.sampling.points, wildcards.sampler
    )


def labelling_priors(wildcards):
    """Return the local feature sizes of the clouds in which a sampler chooses the labelled points."""
    return priors_on(
        wildcards.dataset,
        wildcards.split,
        CONFIG.tasks.segmentation.points,
        wildcards.sampler,
    )


def trained_samplers(wildcards):
    """Return the networks of a sampler for all ratios and seeds; none if it needs no training."""
    return expand(
        TRAINED_SAMPLER,
        dataset=wildcards.dataset,
        sampler=[wildcards.sampler] if wildcards.sampler in LEARNED else [],
        ratio=CONFIG.sampling.ratios,
        seed=range(CONFIG.sampling.seeds),
    )


def transferred_samplers(wildcards):
    """Return the networks of a sampler that choose as many points as are labelled, trained on the first data set."""
    task = CONFIG.tasks.segmentation
    return expand(
        TRAINED_SAMPLER,
        dataset=CONFIG.dataset.name,
        sampler=[wildcards.sampler] if wildcards.sampler in LEARNED else [],
        ratio=[
            ratio
            for ratio in CONFIG.sampling.ratios
            if CONFIG.sampling.points // ratio
            in [task.points // each for each in task.ratios]
        ],
        seed=range(CONFIG.sampling.seeds),
    )


def samples_to_judge(wildcards):
    """Return the folder of chosen points; none where all points are judged."""
    chosen = [] if wildcards.sampler == "all_points" else [wildcards.sampler]
    return expand(
        SAMPLES, dataset=wildcards.dataset, split=wildcards.split, sampler=chosen
    )


def judging_classifiers(wildcards):
    """Return the classifiers that train a sampler; those of Meta-Sampler do not test it."""
    teachers = [
        f"teacher_{number}" for number in range(CONFIG.tasks.classification.teachers)
    ]
    return expand(
        rules.train_classifier.output[0],
        dataset=wildcards.dataset,
        classifier=teachers if wildcards.sampler == "metasampler" else ["task"],
    )


def classifier_settings(wildcards):
    """Return how the classifier that the wildcard names is trained."""
    kind = "plain" if wildcards.classifier == "plain" else "classifier"
    return section("tasks", "classification", kind)


def sampler_settings(wildcards):
    """Return the settings of the network of a sampler; all priors share theirs."""
    if wildcards.sampler in GENERATORS:
        return section("samplers", wildcards.sampler)
    return section("sampling", "network")


def judged(level):
    """Return the result files of every sampler, and of all points, by shape or by draw."""
    return expand(
        JUDGED.format(level=level),
        dataset=CONFIG.dataset.name,
        split=CONFIG.evaluation.split,
        sampler=["all_points", *samplers()] if samplers() else [],
    )


def repeats(wildcards):
    """Tell whether clouds that have too few points repeat them: those for part segmentation, as some are small."""
    task = CONFIG.tasks.segmentation
    return bool(
        task
        and CONFIG.segmented
        and wildcards.dataset == CONFIG.segmented.name
        and int(wildcards.points) == task.points
    )


def strategies():
    """Return the ways to choose labelled points that are compared, if parts can be learned."""
    task = CONFIG.tasks.segmentation
    if not task or not CONFIG.segmented:
        return []
    if ALL_SHAPES[CONFIG.segmented.name].get("train", 0) < 2:
        return []
    possible = [
        name
        for name in possible_samplers()
        if name in TRAINING_FREE + tuple(samplers())
    ]
    return [name for name in task.strategies if name in possible]


def part_splits():
    """Return the splits that segmentation learns from, and the one that chooses the epoch, if there is one."""
    has_validation = "val" in ALL_SHAPES[CONFIG.segmented.name]
    if CONFIG.tasks.segmentation.training == "trainval" and has_validation:
        return ["train", "val"], None
    return ["train"], "val" if has_validation else None


def part_clouds(splits):
    """Return the files of clouds with parts of some splits."""
    return expand(PART_CLOUDS, dataset=CONFIG.segmented.name, split=splits)


def labelled_points(strategy, splits):
    """Return the folders of labelled points of some splits; none if every point has its label."""
    chosen = [] if strategy == EVERY_LABEL else [strategy]
    return expand(
        LABELLED_POINTS, dataset=CONFIG.segmented.name, split=splits, sampler=chosen
    )


def training_labels(wildcards):
    """Return the labelled points of the training splits."""
    return labelled_points(wildcards.strategy, part_splits()[0])


def validation_labels(wildcards):
    """Return the labelled points of the validation split, if there is one."""
    return labelled_points(
        wildcards.strategy, [split for split in part_splits()[1:] if split]
    )


def trained_segmenters(wildcards):
    """Return the networks of a strategy for all ratios and seeds."""
    every = wildcards.strategy == EVERY_LABEL
    return expand(
        TRAINED_SEGMENTER,
        dataset=wildcards.dataset,
        strategy=wildcards.strategy,
        ratio=[1] if every else CONFIG.tasks.segmentation.ratios,
        seed=range(CONFIG.tasks.segmentation.seeds),
    )


def segmented():
    """Return the result files of every strategy, and of all labels."""
    return expand(
        SEGMENTED,
        dataset=CONFIG.segmented.name if CONFIG.segmented else CONFIG.dataset.name,
        split=CONFIG.evaluation.split,
        strategy=[EVERY_LABEL, *strategies()] if strategies() else [],
    )


def learning_tables():
    """Return the tables of classification, retrieval, priors and segmentation, as far as they are run."""
    names = ["object_classification", "point_cloud_retrieval", "skeleton_prior"]
    chosen = names if samplers() else []
    chosen += ["part_segmentation"] if strategies() else []
    return expand(f"{RESULTS}/tables/{{name}}.csv", name=chosen)


def sampling_provenance():
    """Return what the caption of a table of samplers has to tell beside."""
    steps = CONFIG.sampling.steps
    return {
        **provenance(),
        "seeds": CONFIG.sampling.seeds,
        "draws": CONFIG.sampling.draws,
        "budget": (f"{steps} steps" if steps else "published numbers of epochs")
        + f" a training on clouds of {CONFIG.sampling.points} points",
    }


def segmentation_provenance():
    """Return what the caption of the table of part segmentation has to tell beside."""
    if not strategies():
        return {
            **provenance(),
            "transferred_from": CONFIG.dataset.name,
            "seeds": 0,
            "budget": "none run",
            "decisions": [],
        }
    task = CONFIG.tasks.segmentation
    return {
        **provenance(),
        "dataset": CONFIG.segmented.name,
        "transferred_from": CONFIG.dataset.name,
        "seeds": task.seeds,
        "budget": f"{task.network.epochs} epochs a training on clouds of {task.points} points",
        "decisions": describe_decisions(
            section("tasks", "segmentation"),
            part_splits(),
            section("parts" if CONFIG.parts else "dataset").get("axes"),
        ),
    }
