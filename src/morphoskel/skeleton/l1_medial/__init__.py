"""The L1-medial skeleton: curves to which a point cloud contracts (Huang et al., SIGGRAPH 2013)."""

from morphoskel.skeleton.l1_medial.method import l1_medial
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings

__all__ = ["L1MedialSettings", "l1_medial"]
