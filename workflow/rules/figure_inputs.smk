# What the rules of figures and of the report read: their paths, and the helpers that find them.
from morphoskel.reporting.page.assets import assets_digest
from morphoskel.reporting.sampling_names import SAMPLER_NAMES

MANIFEST = f"resources/manifest/{CONFIG.dataset.name}.csv"
ILLUSTRATION = f"{RESULTS}/illustrations/{{shape}}_{{mode}}_{{candidates}}.npz"
WATERTIGHT = f"{RESULTS}/watertight/{{dataset}}/{{split}}/{{surface}}/{{shard}}"

OVERVIEW = "overview"  # stands for the shape in figures.overview
SOLIDS = ("torus", "box")

# The surface on which single figures show MS3D: the best one that is rebuilt.
MAIN_SURFACE = next(
    name
    for name in ("repaired_poisson", "poisson", *CONFIG.surface.names)
    if name in CONFIG.surface.names
)
# With these a function opens the data set that the manifest lists.
SHAPE_SOURCE = {"dataset": section("dataset"), "seed": CONFIG.seed}

# What captions tell of, as text.
NUMBERS = {
    "dataset": CONFIG.dataset.name,
    "split": CONFIG.evaluation.split,
    "shapes": f"{SHAPES[CONFIG.evaluation.split]:,}",
    "candidates": f"{CONFIG.skeleton.candidates.count:,}",
    "k": CONFIG.skeleton.k,
    "points": f"{CONFIG.skeleton.points:,}",
    "cloud_points": f"{CONFIG.sampling.points:,}",
    "draws": CONFIG.sampling.draws,
    "seeds": CONFIG.sampling.seeds,
    "timed": CONFIG.timing.shapes_per_category,
    **{
        name: f"{getattr(CONFIG.figures, name):,}"
        for name in ("sparse", "dense", "rationale", "repeats")
    },
    "illustrated": f"{CONFIG.figures.candidates:,}",
}
if strategies():
    NUMBERS |= {
        "segmented": CONFIG.segmented.name,
        "segmented_shapes": f"{ALL_SHAPES[CONFIG.segmented.name][CONFIG.evaluation.split]:,}",
        "segmented_training": f"{sum(ALL_SHAPES[CONFIG.segmented.name][split] for split in part_splits()[0]):,}",
        "segmented_points": f"{CONFIG.tasks.segmentation.points:,}",
        "segmented_seeds": CONFIG.tasks.segmentation.seeds,
    }


def numbers(figure):
    """Return those that the caption of a figure tells of; only if they change is it drawn anew."""
    caption = Path(workflow.basedir, f"workflow/report/{figure}.rst").read_text()
    return {name: NUMBERS[name] for name in re.findall(r"numbers\.(\w+)", caption)}


def flat(files):
    """Return all paths in nested lists and mappings."""
    if isinstance(files, dict):
        return flat(list(files.values()))
    if files is None or isinstance(files, str):
        return [files] if files else []
    return [path for file in files for path in flat(file)]


def illustration(shape, count=CONFIG.figures.candidates, mode="random"):
    """Return the file of a shape with all that lies between the stages kept."""
    return ILLUSTRATION.format(shape=shape, mode=mode, candidates=count)


def rationale_illustrations():
    """Return the illustrations of each solid with random candidates, and with a grid of them."""
    count = CONFIG.figures.rationale
    return {
        "solids": {
            name: [illustration(name, count, mode) for mode in ("random", "grid")]
            for name in SOLIDS
        }
    }


def of_surface(surface):
    """Return the folders of closed surfaces and of MS3D's skeletons of the evaluated split."""
    split = CONFIG.evaluation.split
    return {
        "surfaces": of_shards(WATERTIGHT, split, surface=surface),
        "skeletons": of_shards(SKELETONS, split, surface=surface, skeleton="ms3d"),
    }


def by_surface(kind):
    """Return the folders of either kind for every surface reconstruction."""
    return {surface: of_surface(surface)[kind] for surface in CONFIG.surface.names}


def shown_clouds(pattern=SAMPLED_CLOUDS):
    """Return the file of the evaluated split's clouds."""
    return pattern.format(dataset=CONFIG.dataset.name, split=CONFIG.evaluation.split)


def shown_priors():
    """Return the file of local feature sizes to MS3D's skeleton, if a sampler needs it."""
    needed = [name for name in ("lfs", "ms3d") if name in samplers()]
    files = [
        path
        for name in needed
        for path in priors_on(
            CONFIG.dataset.name, CONFIG.evaluation.split, CONFIG.sampling.points, name
        )
    ]
    return files[0] if files else None


def shown_samples():
    """Return the folders of the points that some samplers chose."""
    wanted = ("fps", "samplenet", "skeleton_aware", "ms3d")
    return {
        name: SAMPLES.format(
            dataset=CONFIG.dataset.name, split=CONFIG.evaluation.split, sampler=name
        )
        for name in wanted
        if name in samplers()
    }


def shown_segmenters():
    """Return clouds, networks and results of MS3D with fewest labels, and of all labels."""
    dataset, split = CONFIG.segmented.name, CONFIG.evaluation.split
    ratios = {
        "ms3d": max(CONFIG.tasks.segmentation.ratios),
        **{EVERY_LABEL: 1},
    }
    shown = [name for name in ratios if name in (EVERY_LABEL, *strategies())]
    return {
        "clouds": PART_CLOUDS.format(dataset=dataset, split=split),
        "networks": {
            name: TRAINED_SEGMENTER.format(
                dataset=dataset, strategy=name, ratio=ratios[name], seed=0
            )
            for name in shown
        },
        "evaluations": {
            name: SEGMENTED.format(dataset=dataset, split=split, strategy=name)
            for name in shown
        },
    }


def overview_source(wildcards=None):
    """Return the user's file with the shape of the overview, if it is one."""
    return [] if CONFIG.figures.overview == "dragon" else [CONFIG.figures.overview]


def scores(*tables):
    """Return tables of samplers, and the results of every draw."""
    return {
        "tables": expand(f"{RESULTS}/tables/{{table}}.csv", table=tables),
        "draw_rows": judged("draws"),
    }


def every_figure():
    """Return the titles of all figures that this run can draw, by name, in the order of the report."""
    titles = {
        "overview": "From a cloud to its skeleton",
        "occupancy": "Occupancy",
        "dilation": "Distance and dilation",
        "residue": "Residue and skeletal points",
        "candidates": "More candidates",
        "rationale": "Torus and box",
        "skeleton_sheet": "A skeleton of every category",
        "spheres": "Balls and surface points",
        "skeletons": "Every method",
        "reconstructions": "Every surface reconstruction",
        "explanation": "What the balls leave bare",
        "distances": "Distances of the methods",
        "surface_distances": "Distances of the surface reconstructions",
        "stage_times": "Time of every stage",
        "scaling": "Time and candidates",
        "size_map": "Local feature size",
        "samples": "Chosen points",
        "accuracy": "Accuracy and number of points",
        "retrieval": "Retrieval and number of points",
        "labels": "Parts and number of labels",
        "segmentation": "Parts told and true",
        "contact_sheet": "The data set",
    }
    possible = {
        "explanation": len(CONFIG.skeleton.selection) > 1,
        "size_map": shown_priors(),
        "samples": shown_samples(),
        **dict.fromkeys(("accuracy", "retrieval"), samplers()),
        **dict.fromkeys(("labels", "segmentation"), strategies()),
    }
    return {name: title for name, title in titles.items() if possible.get(name, True)}


def every_table():
    """Return the CSV files of all tables of this run."""
    names = ("skeleton_reconstruction", "surface_reconstruction", "processing_time")
    return [*expand(f"{RESULTS}/tables/{{name}}.csv", name=names), *learning_tables()]


def scene_files():
    """Return what the shapes to turn are read from, as the report's `SceneSources` name it."""
    dataset, split = CONFIG.dataset.name, CONFIG.evaluation.split
    found = of_surface(MAIN_SURFACE)
    stages = ("occupancy", "udf", "dilation") if CONFIG.keep_intermediates else ()
    folder = f"{RESULTS}/{{stage}}/{{dataset}}/{{split}}/{{surface}}/{{shard}}"
    return {
        "manifest": MANIFEST,
        "watertight": found["surfaces"],
        "skeletons": found["skeletons"],
        "inner": {
            stage: of_shards(folder, split, stage=stage, surface=MAIN_SURFACE)
            for stage in stages
        },
        "clouds": shown_clouds() if shown_samples() else None,
        "samples": {
            SAMPLER_NAMES[name]: folder for name, folder in shown_samples().items()
        },
    }
