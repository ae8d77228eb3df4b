"""Points in the volume: candidates, the inside test and the distance to the surface."""

from morphoskel.volume.candidates import Candidates
from morphoskel.volume.distance import SurfaceDistance
from morphoskel.volume.occupancy import Occupancy, occupancy

__all__ = ["Candidates", "Occupancy", "SurfaceDistance", "occupancy"]
