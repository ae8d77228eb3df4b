"""Draw meshes, balls and points as one camera under one light sees them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray, IntArray, Mesh, Skeleton

Image = npt.NDArray[np.float64]
LIGHT = np.array([0.35, 0.65, 0.68])
"""Direction towards the light, in camera coordinates (right, up, towards the viewer)."""

SURFACE_COLOUR = (0.72, 0.76, 0.82)
VEIL_COLOUR = np.array([0.45, 0.5, 0.58])

OVERSAMPLING = 2
"""Rays along each side of a pixel."""

FRAGMENTS = 1 << 21
"""Rays that may meet balls, looked at together; bounds the memory."""


@dataclass(frozen=True)
class View:
    """An orthographic camera that looks at the middle of a box.

    Parameters
    ----------
    azimuth, elevation
        Degrees; at 0 and 0 the camera looks along -z with y up.
    pixels
        Side of the square picture.
    """

    azimuth: float = 35.0
    elevation: float = 20.0
    pixels: int = 700

    def axes(self) -> FloatArray:
        """Return right, up and backward directions as rows, ``(3, 3)``."""
        azimuth, elevation = np.radians([self.azimuth, self.elevation])
        backward = np.array(
            [np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)]
        )
        right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
        return np.stack([right, np.cross(backward, right), backward])


FROM_THE_FRONT = View(azimuth=235.0, elevation=22.0)
"""Of the published data sets, whose shapes have y up and face negative z."""


class Canvas:
    """A square picture to which opaque things are added in any order, then veils.

    Parameters
    ----------
    view
        The camera.
    bounds
        ``(2, 3)``, lower and upper corner of the box that the picture covers, with a small margin.
    """

    def __init__(self, view: View, bounds: npt.ArrayLike) -> None:
        lower, upper = np.asarray(bounds, dtype=np.float64)
        corners = np.stack(np.meshgrid(*zip(lower, upper, strict=True)), axis=-1).reshape(-1, 3)
        self.axes = view.axes()
        self.centre = (lower + upper) / 2
        self.half = max(1.04 * float(np.abs((corners - self.centre) @ self.axes[:2].T).max()), 1e-12)
        self.far = 2 * float(np.linalg.norm(upper - lower)) + self.half
        self.side = view.pixels * OVERSAMPLING
        self.depth = np.full((self.side, self.side), -np.inf)
        self.colours: Image = np.ones((self.side, self.side, 3))

    def add_mesh(self, mesh: Mesh, colours: npt.ArrayLike = SURFACE_COLOUR) -> None:
        """Add an opaque mesh of one colour, or ``(T, 3)`` of its triangles, each red, green and blue in [0, 1]."""
        depth, normals, triangle = self._cast(mesh)
        seen = depth > self.depth
        of_triangle = np.broadcast_to(np.asarray(colours, dtype=np.float64), (len(mesh.triangles), 3))
        self.depth[seen] = depth[seen]
        self.colours[seen] = _shade(of_triangle[triangle[seen]], normals[seen])

    def add_balls(self, centres: FloatArray, radii: npt.ArrayLike, colours: npt.ArrayLike) -> None:
        """Add opaque balls.

        Parameters
        ----------
        centres
            ``(K, 3)``.
        radii
            ``(K,)``, or one of all; a ball thinner than a ray is drawn as thin as one.
        colours
            ``(K, 3)`` or ``(3,)``, red, green and blue in [0, 1].
        """
        count = len(centres)
        where = (np.asarray(centres, dtype=np.float64) - self.centre) @ self.axes.T
        pixel = 2 * self.half / self.side
        sizes = np.maximum(np.broadcast_to(np.asarray(radii, dtype=np.float64), count), 0.75 * pixel)
        of_ball = np.broadcast_to(np.asarray(colours, dtype=np.float64), (count, 3))
        for ball, row, column in self._squares(where, sizes):
            across = (column + 0.5) * pixel - self.half - where[ball, 0]
            along = self.half - (row + 0.5) * pixel - where[ball, 1]
            height = sizes[ball] ** 2 - across**2 - along**2
            inside = (height >= 0) & (row >= 0) & (row < self.side) & (column >= 0) & (column < self.side)
            height = np.sqrt(height, where=inside, out=np.full_like(height, -np.inf))
            front = self._nearest((row * self.side + column) * inside, where[ball, 2] + height)
            normals = np.stack([across[front], along[front], height[front]], axis=1) / sizes[ball[front]][:, None]
            self.colours[row[front], column[front]] = _shade(of_ball[ball[front]], normals)

    def add_points(self, points: FloatArray, colours: npt.ArrayLike, size: float = 0.004) -> None:
        """Add points as small balls, `size` is their radius in sides of the picture."""
        self.add_balls(points, 2 * self.half * size, colours)

    def add_veil(self, mesh: Mesh, opacity: float = 0.16) -> None:
        """Lay a translucent surface over all that was added; its outline is denser than where it faces the viewer."""
        depth, normals, _ = self._cast(mesh)
        covered = np.isfinite(depth)
        facing = np.abs(normals[covered, 2])
        share = (opacity + (0.75 - opacity) * (1 - facing) ** 3)[:, None]
        self.colours[covered] = (1 - share) * self.colours[covered] + share * VEIL_COLOUR

    def image(self) -> Image:
        """Return the picture, ``(pixels, pixels, 3)`` float64 in [0, 1], on white, with smooth edges."""
        side = self.side // OVERSAMPLING
        blocks = self.colours.reshape(side, OVERSAMPLING, side, OVERSAMPLING, 3)
        smooth: Image = blocks.mean(axis=(1, 3))
        return smooth

    def _squares(self, where: FloatArray, sizes: FloatArray) -> Iterator[tuple[IntArray, IntArray, IntArray]]:
        """Yield ball, row and column of the rays in the square around each ball, some balls of like size at a time."""
        rays = self.side / (2 * self.half)
        reach = np.ceil(sizes * rays).astype(np.int64) + 1
        middle = np.floor(np.stack([self.half - where[:, 1], where[:, 0] + self.half], axis=1) * rays).astype(np.int64)
        order = np.argsort(reach, kind="stable")
        start = 0
        while start < len(order):
            # A chunk has squares of one size; balls of up to twice the size of the first are worth it.
            most = 2 * reach[order[start]]
            end = min(
                np.searchsorted(reach[order], most, side="right"), start + max(FRAGMENTS // (2 * most + 1) ** 2, 1)
            )
            chunk = order[start:end]
            steps = np.arange(-reach[chunk[-1]], reach[chunk[-1]] + 1)
            ball, down, right = np.broadcast_arrays(chunk[:, None, None], steps[:, None], steps)
            yield ball.ravel(), (middle[ball, 0] + down).ravel(), (middle[ball, 1] + right).ravel()
            start = int(end)

    def _nearest(self, ray: IntArray, depth: FloatArray) -> IntArray:
        """Keep the depth of each ray's nearest fragment, if it is nearer than what is there; return those fragments."""
        depths = self.depth.ravel()
        nearer: IntArray = np.flatnonzero(depth > depths[ray])
        nearer = nearer[np.argsort(depth[nearer], kind="stable")]
        # Of several values for one place, NumPy keeps the last, which is the nearest.
        depths[ray[nearer]] = depth[nearer]
        front: IntArray = nearer[depths[ray[nearer]] == depth[nearer]]
        return front

    def _cast(self, mesh: Mesh) -> tuple[FloatArray, FloatArray, npt.NDArray[np.uint32]]:
        """Return depth towards the viewer (minus infinity where nothing is hit), the normal and the triangle, a ray."""
        import open3d

        steps = ((np.arange(self.side) + 0.5) / self.side * 2 - 1) * self.half
        across, along = np.meshgrid(steps, -steps)
        right, up, backward = self.axes
        origins = self.centre + across[..., None] * right + along[..., None] * up + self.far * backward
        rays = np.concatenate([origins, np.broadcast_to(-backward, origins.shape)], axis=-1).astype(np.float32)
        scene = open3d.t.geometry.RaycastingScene()
        scene.add_triangles(
            open3d.core.Tensor.from_numpy(mesh.vertices.astype(np.float32)),
            open3d.core.Tensor.from_numpy(mesh.triangles.astype(np.uint32)),
        )
        hits = scene.cast_rays(open3d.core.Tensor.from_numpy(rays))
        normals = hits["primitive_normals"].numpy().astype(np.float64) @ self.axes.T
        normals[normals[..., 2] < 0] *= -1
        return self.far - hits["t_hit"].numpy().astype(np.float64), normals, hits["primitive_ids"].numpy()


def render_mesh(mesh: Mesh, view: View, colours: npt.ArrayLike = SURFACE_COLOUR) -> Image:
    """Draw an opaque mesh.

    Parameters
    ----------
    mesh
        The mesh.
    view
        The camera.
    colours
        ``(3,)`` or ``(T, 3)``, red, green and blue in [0, 1] of the whole mesh or of each triangle.

    Returns
    -------
    ndarray
        ``(pixels, pixels, 3)`` float64 in [0, 1], on white.
    """
    canvas = Canvas(view, mesh.bounds)
    canvas.add_mesh(mesh, colours)
    return canvas.image()


def render_balls(
    skeleton: Skeleton, colours: npt.ArrayLike, view: View, *, under: Mesh | None = None, veil: float = 0.16
) -> Image:
    """Draw balls, if wanted under a translucent surface.

    Parameters
    ----------
    skeleton
        Centres and radii.
    colours
        ``(K, 3)`` or ``(3,)`` in [0, 1].
    view
        The camera.
    under
        A surface drawn as a veil over the balls; the picture then covers its box.
    veil
        Opacity of the surface where it faces the viewer.

    Returns
    -------
    ndarray
        ``(pixels, pixels, 3)`` float64 in [0, 1], on white.
    """
    canvas = Canvas(view, under.bounds if under is not None else ball_bounds(skeleton))
    canvas.add_balls(skeleton.points, skeleton.radii, colours)
    if under is not None:
        canvas.add_veil(under, veil)
    return canvas.image()


def ball_bounds(skeleton: Skeleton) -> FloatArray:
    """Return the box around balls, ``(2, 3)``."""
    radii = skeleton.radii[:, None]
    return np.stack([(skeleton.points - radii).min(axis=0), (skeleton.points + radii).max(axis=0)])


def _shade(colours: FloatArray, normals: FloatArray) -> Image:
    """Return colours under the light, for normals in camera coordinates."""
    brightness = 0.35 + 0.65 * np.clip(normals @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
    shaded: Image = np.clip(colours * brightness[..., None], 0, 1)
    return shaded
