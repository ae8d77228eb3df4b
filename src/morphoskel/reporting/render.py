"""Draw meshes, and balls inside them, by casting rays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from morphoskel.shapes import FloatArray, Mesh, Skeleton
from morphoskel.skeleton.ball_mesh import ball_mesh

Image = npt.NDArray[np.float64]
LIGHT = np.array([0.35, 0.65, 0.68])
"""Direction towards the light, in camera coordinates (right, up, towards the viewer)."""

SURFACE_COLOUR = (0.72, 0.76, 0.82)
VEIL_COLOUR = np.array([0.45, 0.5, 0.58])

OVERSAMPLING = 2
"""Rays along each side of a pixel."""

SUBDIVISIONS = 3
"""Of the icospheres that stand for balls."""


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

    def rays(self, lower: FloatArray, upper: FloatArray) -> npt.NDArray[np.float32]:
        """Return origins and directions, ``(side, side, 6)`` float32, that cover the box with a small margin."""
        right, up, backward = self.axes()
        corners = np.stack(np.meshgrid(*zip(lower, upper, strict=True)), axis=-1).reshape(-1, 3)
        centre, radius = (lower + upper) / 2, float(np.linalg.norm(upper - lower)) / 2
        half = 1.04 * max(np.abs((corners - centre) @ axis).max() for axis in (right, up))
        side = self.pixels * OVERSAMPLING
        steps = (np.arange(side) + 0.5) / side * 2 - 1
        across, along = np.meshgrid(steps * half, -steps * half)
        origins = centre + across[..., None] * right + along[..., None] * up + 2 * radius * backward
        return np.concatenate([origins, np.broadcast_to(-backward, origins.shape)], axis=-1).astype(np.float32)


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
    depth, normals, triangle = _cast(mesh, view.rays(*mesh.bounds))
    hit = np.isfinite(depth)
    picture: Image = np.ones((*depth.shape, 3))
    of_triangle = np.broadcast_to(np.asarray(colours, dtype=np.float64), (len(mesh.triangles), 3))
    picture[hit] = _shade(of_triangle[triangle[hit]], normals[hit], view)
    return _smooth(picture)


def render_balls(
    skeleton: Skeleton, colours: FloatArray, view: View, *, under: Mesh | None = None, veil: float = 0.16
) -> Image:
    """Draw balls, if wanted under a translucent surface.

    Parameters
    ----------
    skeleton
        Centres and radii.
    colours
        ``(K, 3)`` in [0, 1], one a ball.
    view
        The camera.
    under
        A surface drawn as a veil over the balls.
    veil
        Opacity of the surface where it faces the viewer; its outline is denser.

    Returns
    -------
    ndarray
        ``(pixels, pixels, 3)`` float64 in [0, 1], on white.
    """
    balls, owner = ball_mesh(skeleton, subdivisions=SUBDIVISIONS)
    rays = view.rays(*(under or balls).bounds)
    picture: Image = np.ones((*rays.shape[:2], 3))
    depth, normals, triangle = _cast(balls, rays)
    hit = np.isfinite(depth)
    ball = owner[balls.triangles[triangle[hit], 0]]
    where = rays[hit][:, :3] + depth[hit][:, None] * rays[hit][:, 3:]
    normals[hit] = (where - skeleton.points[ball]) / np.maximum(skeleton.radii[ball], 1e-12)[:, None]
    picture[hit] = _shade(colours[ball], normals[hit], view)
    if under is not None:
        depth, normals, _ = _cast(under, rays)
        covered = np.isfinite(depth)
        facing = np.abs(normals[covered] @ view.axes()[2])
        opacity = (veil + (0.75 - veil) * (1 - facing) ** 3)[:, None]
        picture[covered] = (1 - opacity) * picture[covered] + opacity * VEIL_COLOUR
    return _smooth(picture)


def _smooth(picture: Image) -> Image:
    """Average blocks of rays into pixels, so that edges are not jagged."""
    side = len(picture) // OVERSAMPLING
    blocks = picture.reshape(side, OVERSAMPLING, side, OVERSAMPLING, 3)
    smooth: Image = blocks.mean(axis=(1, 3))
    return smooth


def _shade(colour: FloatArray, normals: FloatArray, view: View) -> Image:
    light = LIGHT @ view.axes() / np.linalg.norm(LIGHT)
    brightness = 0.35 + 0.65 * np.clip(normals @ light, 0, 1)
    return np.clip(colour * brightness[..., None], 0, 1)


def _cast(mesh: Mesh, rays: npt.NDArray[np.float32]) -> tuple[FloatArray, FloatArray, npt.NDArray[np.uint32]]:
    """Return depth (infinite where nothing is hit), the normal turned to the viewer, and the triangle, a pixel."""
    import open3d

    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(
        open3d.core.Tensor.from_numpy(mesh.vertices.astype(np.float32)),
        open3d.core.Tensor.from_numpy(mesh.triangles.astype(np.uint32)),
    )
    hits = scene.cast_rays(open3d.core.Tensor.from_numpy(rays))
    normals = hits["primitive_normals"].numpy().astype(np.float64)
    away = np.einsum("...i,...i->...", normals, rays[..., 3:]) > 0
    normals[away] *= -1
    return hits["t_hit"].numpy().astype(np.float64), normals, hits["primitive_ids"].numpy()
