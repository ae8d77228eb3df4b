"""The L1-medial skeleton of a point cloud (Huang et al., SIGGRAPH 2013)."""

from __future__ import annotations

import numpy as np

from morphoskel.errors import ShapeError
from morphoskel.shapes import FloatArray, PointCloud, Skeleton
from morphoskel.skeleton.ball_radii import radii_of
from morphoskel.skeleton.l1_medial.branches import Branch, BranchSearch, bridges_of
from morphoskel.skeleton.l1_medial.bridges import drop_lost_bridge, follow, grow, join_body
from morphoskel.skeleton.l1_medial.contraction import contract, density_weights, explained_by_branches, first_radius
from morphoskel.skeleton.l1_medial.directionality import update_smoothed_directionality
from morphoskel.skeleton.l1_medial.merging import merge_ends
from morphoskel.skeleton.l1_medial.nodes import assemble
from morphoskel.skeleton.l1_medial.samples import FIXED, MOVING, REMOVED, Samples
from morphoskel.skeleton.l1_medial.settings import L1MedialSettings


def l1_medial(
    cloud: PointCloud,
    generator: np.random.Generator,
    settings: L1MedialSettings = L1MedialSettings(),  # noqa: B008 - it is frozen
) -> Skeleton:
    """Return the curve skeleton to which the points of a cloud contract.

    Some of the points are drawn to the centres of their neighbourhoods, while they repel each other. Where they form a
    line, they are fixed as a branch; then the neighbourhoods grow. The branches grow and merge on the way, and become
    evenly spaced curves at the end.

    Parameters
    ----------
    cloud
        Points on the surface, or on a part of it; normals are not used.
    generator
        Chooses the points.
    settings
        Parameters; those of the released program by default.

    Returns
    -------
    Skeleton
        Nodes of the curves, first the curves one by one, then the samples that ended on no curve. The edges join
        consecutive nodes; curves that meet share a node. No residues.

    Raises
    ------
    ShapeError
        If no branch is found, and the samples that ended on none are not kept.

    Notes
    -----
    Follows the released program, with these simplifications: the state of a bridge depends on the samples around it
    alone; a branch that reaches another one ends there, instead of moving on; curves are resampled along straight
    lines, not by subdivision; and they are recentred, as in the paper, but without fitting ellipses. As there, the
    last stage may end before all bridges have arrived, so that a branch stops short of a junction.

    References
    ----------
    H. Huang, S. Wu, D. Cohen-Or, M. Gong, H. Zhang, G. Li, B. Chen: L1-medial skeleton of point cloud. ACM Transactions
    on Graphics (SIGGRAPH) 32(4), 2013.
    """
    lower, upper = cloud.points.min(axis=0), cloud.points.max(axis=0)
    middle, scale = (lower + upper) / 2, float((upper - lower).max())
    points = (cloud.points - middle) / scale
    contraction = _Contraction(points, generator, settings)
    contraction.run()
    nodes, edges = assemble(contraction.branches, contraction.samples, points, settings)
    if len(nodes) == 0:
        raise ShapeError(
            "L1-medial skeleton: no part of the shape contracts to a line; lower the directionality "
            f"({settings.directionality}) or the samples of a branch ({settings.branch_samples}), or keep the leftover "
            "samples (keep_leftover)"
        )
    centres = nodes * scale + middle
    return Skeleton(centres, radii_of(centres, cloud.points, settings.radius), edges=edges)


class _Contraction:
    """The stages of a contraction; all lengths in units of the longest side of the bounding box."""

    def __init__(self, points: FloatArray, generator: np.random.Generator, settings: L1MedialSettings) -> None:
        chosen = generator.choice(len(points), min(settings.samples, len(points) // 2), replace=False)
        self.points = points
        self.settings = settings
        self.samples = Samples(points[chosen])
        self.branches: list[Branch] = []
        self.first_radius = self.radius = first_radius(points, settings.radius_factor)
        self.weights = np.ones(len(points))
        if settings.density_weights:
            self.weights = density_weights(points, self.radius)
        self.density_weights = self.weights

    def run(self) -> None:
        """Run stages until few samples move or the neighbourhoods hold the whole shape."""
        while True:
            self._contract_fully()
            self._remove_duplicates()
            update_smoothed_directionality(self.samples, self.settings.directionality_neighbours)
            self._find_branches()
            self._grow_branches()
            merge_ends(self.branches, self.samples, self.settings, join=True)
            self._remove_near_branches()
            explained = explained_by_branches(self.points, self.samples, self.radius)
            self.weights = self.density_weights * np.where(explained, self.settings.explained_weight, 1)
            self.radius *= 1 + self.settings.radius_growth
            few = len(self.samples.indices(MOVING)) <= self.settings.branch_samples
            if few or self.radius > self.settings.largest_radius:
                break
        self._finish_bridges()

    def _contract_fully(self) -> None:
        """Move the samples until they stay where they are; the branches follow."""
        for _ in range(self.settings.iterations):
            for branch in self.branches:
                for _ in branch.both_ways():
                    follow(branch, self.samples, self.settings)
            self._grow_branches()
            self._finish_bridges()
            self._remove_near_branches()
            moved = contract(self.samples, self.points, self.weights, self.radius, self.settings)
            if moved < self.settings.displacement:
                break

    def _find_branches(self) -> None:
        """Trace branches until no candidate is left; what is too short moves on."""
        search = BranchSearch(self.samples, self.branches, self.settings)
        least = self.settings.branch_samples + int(self.radius / self.first_radius)
        while (seed := search.seed()) is not None:
            branch = search.trace(seed)
            if branch is None:
                search.reject([seed])
                continue
            before = self.samples.states.copy()
            self.samples.states[branch.fixed_nodes] = FIXED
            for _ in branch.both_ways():
                grow(branch, self.samples, search.bridges, self.settings)
            if len(branch.nodes) < least:
                self.samples.states[branch.nodes] = before[branch.nodes]
                search.reject(branch.fixed_nodes)
            else:
                self.branches.append(branch)
                search.accept(branch)

    def _grow_branches(self) -> None:
        for branch in self.branches:
            for _ in branch.both_ways():
                grow(branch, self.samples, bridges_of(self.branches), self.settings)

    def _finish_bridges(self) -> None:
        """End the branches whose bridges have arrived somewhere or are lost."""
        merge_ends(self.branches, self.samples, self.settings, join=False)
        for branch in self.branches:
            for _ in branch.both_ways():
                join_body(branch, self.branches, self.samples, self.settings)
                drop_lost_bridge(branch, self.samples, self.settings)

    def _remove_duplicates(self) -> None:
        """Remove moving samples that are at the place of another one; the first of them stays."""
        from scipy.spatial import cKDTree

        live = self.samples.indices(MOVING, FIXED)
        kept = bridges_of(self.branches)
        pairs = cKDTree(self.samples.points[live]).query_pairs(self.settings.duplicate_distance, output_type="ndarray")
        for first, second in live[pairs[np.lexsort(pairs.T[::-1])]].tolist():
            if REMOVED in self.samples.states[[first, second]]:
                continue
            for sample in (second, first):
                if self.samples.states[sample] == MOVING and sample not in kept:
                    self.samples.states[sample] = REMOVED
                    break

    def _remove_near_branches(self) -> None:
        """Remove moving samples close to a branch, except for bridges."""
        from scipy.spatial import cKDTree

        fixed, moving = self.samples.indices(FIXED), self.samples.indices(MOVING)
        moving = np.setdiff1d(moving, list(bridges_of(self.branches)))
        if len(fixed) and len(moving):
            distances = cKDTree(self.samples.points[fixed]).query(self.samples.points[moving])[0]
            self.samples.states[moving[distances < self.settings.clean_distance]] = REMOVED
