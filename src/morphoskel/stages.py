"""The stages of the per-shape chain."""

STAGES = ("reconstruct", "watertight", "occupancy", "udf", "dilation", "select_skeleton")
"""In order. Each is a rule of the workflow and a module of :mod:`morphoskel.chain`."""

SKELETON_STAGES = STAGES[2:]
"""The stages whose sum the paper times as MS3D."""

TIMED_STAGES = (*STAGES, "cover_skeleton")
"""The stages with a time of their own: beside the chain, the selection that may take the place of its last stage."""
