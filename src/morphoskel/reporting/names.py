"""How tables call what the configuration calls differently."""

SURFACE_NAMES = {"poisson": "Poisson", "ball_pivoting": "BPA", "alpha_shape": "Alpha", "ponq": "PoNQ"}
"""Surface reconstructions, as in the paper's tables."""

SKELETON_NAMES = {
    "ms3d": "MS3D",
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
