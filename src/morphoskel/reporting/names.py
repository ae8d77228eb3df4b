"""How tables call what the configuration calls differently."""

SURFACE_NAMES = {
    "poisson": "Poisson",
    "ball_pivoting": "BPA",
    "alpha_shape": "Alpha",
    "ponq": "PoNQ",
    "repaired_poisson": "repaired Poisson",
}
"""Surface reconstructions, as in the paper's tables."""

SKELETON_NAMES = {
    "ms3d": "MS3D",
    "ms3d_coverage": "MS3D coverage",
    "l1_medial": "L1",
    "dpc": "DPC",
    "point2skeleton": "P2S",
    "coverage_axis": "Coverage Axis++",
}
"""Skeleton methods, as in the paper's tables where it has them."""


def surface_name(name: str) -> str:
    """Return the surface reconstruction's name for readers; an unknown one keeps its own."""
    return SURFACE_NAMES.get(name, name)


def skeleton_name(name: str) -> str:
    """Return the skeleton method's name for readers; an unknown one keeps its own."""
    return SKELETON_NAMES.get(name, name)


def method_name(method: str, surface: str, balls: str = "as is") -> str:
    """Return the name of a row that compares methods.

    The paper's own rows keep its names: a method on Poisson surfaces or on the cloud itself, and Point2Skeleton with
    the dense balls that its results are published for.

    Parameters
    ----------
    method, surface
        Names of the configuration; the surface is empty or ``cloud`` for a method that needs none.
    balls
        Kind of balls, see :mod:`morphoskel.evaluation.skeletons`.
    """
    name = skeleton_name(method)
    if surface not in ("", "cloud", "poisson"):
        name = f"{name}, {surface_name(surface)}"
    if method == "point2skeleton":
        return {"as is": f"{name}, own balls", "dense": name}.get(balls, f"{name}, {balls} balls")
    return name if balls == "as is" else f"{name}, {balls} balls"
