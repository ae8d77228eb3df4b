"""Points in the volume: candidates, the inside test and the distance to the surface."""

from morphoskel.volume.candidates import Candidates
from morphoskel.volume.occupancy import inner_points, occupancy
from morphoskel.volume.surface_query import SurfaceQuery

__all__ = ["Candidates", "SurfaceQuery", "inner_points", "occupancy"]
