"""PoNQ in its optimisation mode: points, normals and quadrics fitted to a cloud (Maruani et al., CVPR 2024)."""

from morphoskel.surface.ponq.reconstruction import reconstruct_ponq
from morphoskel.surface.ponq.settings import PRESETS, PonqSettings

__all__ = ["PRESETS", "PonqSettings", "reconstruct_ponq"]
