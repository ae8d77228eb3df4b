# Which skeletons are compared, and the files of the chain that tables, figures and samplers are made from.
from morphoskel.methods import CLOUD_METHODS, MORPHOLOGICAL


def skeleton_methods():
    """Return (surface, method) of every skeleton that is compared, in the order of the tables."""
    selections = {"residue": "ms3d", "coverage": "ms3d_coverage"}
    chosen = [selections[name] for name in CONFIG.skeleton.selection]
    others = CONFIG.methods.names
    if "point2skeleton" in others and not can_have_network():
        others.remove("point2skeleton")
    on_surfaces = [*chosen, *(["coverage_axis"] if "coverage_axis" in others else [])]
    compared = [(CLOUD, method) for method in CLOUD_METHODS if method in others]
    for surface in CONFIG.surface.names:
        if surface in ("poisson", "repaired_poisson"):
            compared += [(surface, method) for method in on_surfaces]
    return compared


def surface_methods():
    """Return (surface, method) of every surface reconstruction that is compared, and of Point2Skeleton beside them."""
    compared = [
        (surface, "ms3d")
        for surface in CONFIG.surface.names
        if "residue" in CONFIG.skeleton.selection
    ]
    return compared + [
        pair for pair in skeleton_methods() if pair == (CLOUD, "point2skeleton")
    ]


def can_have_network():
    """Tell whether Point2Skeleton is trained already or can be."""
    return bool(CONFIG.methods.point2skeleton.trained) or SHAPES.get("train", 0) > 1


def of_shards(pattern, split, dataset=CONFIG.dataset.name, **wildcards):
    """Return the folders of all shards of a split."""
    return expand(
        pattern,
        dataset=dataset,
        split=split,
        shard=shards(split, dataset),
        **wildcards,
    )


def skeleton_shards(wildcards):
    """Return the skeleton folders of one split, surface and method."""
    return of_shards(
        SKELETONS,
        wildcards.split,
        surface=wildcards.surface,
        skeleton=wildcards.skeleton,
    )


def axis_shards(wildcards):
    """Return the folders of reference axes of one split, if there are any."""
    known = (
        CONFIG.medial_axis.folder or CONFIG.medial_axis.surface in CONFIG.surface.names
    )
    return of_shards(AXES, wildcards.split) if known else []


def evaluated_balls(wildcards):
    """Return which balls of a method's skeletons are evaluated."""
    dense = (
        CONFIG.methods.point2skeleton.dense_balls
        if wildcards.skeleton == "point2skeleton"
        else None
    )
    return {"equal_counts": list(CONFIG.evaluation.equal_counts), "dense": dense}


def every_skeleton():
    """Return the skeleton folders of every split, surface reconstruction and method."""
    pairs = dict.fromkeys([*skeleton_methods(), *surface_methods()])
    return [
        folder
        for split in SHAPES
        for surface, method in pairs
        for folder in of_shards(SKELETONS, split, surface=surface, skeleton=method)
    ]


def gallery_skeletons():
    """Return the skeleton folders of the evaluated split by surface and method, joined with a slash."""
    pairs = dict.fromkeys([*skeleton_methods(), *surface_methods()])
    return {
        f"{surface}/{method}": of_shards(
            SKELETONS, CONFIG.evaluation.split, surface=surface, skeleton=method
        )
        for surface, method in pairs
    }


def explained_skeletons():
    """Return the part of the gallery in which the selections of MS3D differ."""
    wanted = [
        f"{surface}/{method}"
        for surface in ("poisson", "repaired_poisson")
        for method in MORPHOLOGICAL
    ]
    gallery = gallery_skeletons()
    return {pair: gallery[pair] for pair in wanted if pair in gallery}


def evaluations(pairs):
    """Return the result files of the evaluated split for each (surface, method)."""
    return [
        path
        for surface, method in pairs
        for path in expand(
            EVALUATION,
            dataset=CONFIG.dataset.name,
            split=CONFIG.evaluation.split,
            surface=surface,
            skeleton=method,
        )
    ]
