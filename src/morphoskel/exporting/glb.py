"""Write coloured parts as binary glTF."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from morphoskel.atomic import atomic_file
from morphoskel.exporting.coloured_parts import ColouredPart
from morphoskel.exporting.single_precision import as_float32

ROUGHNESS = 0.6


def write_glb(path: Path, parts: Sequence[ColouredPart]) -> None:
    """Write each part as a named node with one mesh.

    All balls are one mesh with colours at its vertices. Instances of a single ball would make a smaller file, but a
    node for each ball is one draw call for each, which stalls viewers at a thousand balls, and the extension that draws
    them all at once (EXT_mesh_gpu_instancing) neither opens in Blender nor colours each ball.

    Parameters
    ----------
    path
        File to write.
    parts
        Triangles are shaded smoothly and not metallic; translucent parts are blended. Segments become lines.

    Raises
    ------
    InputError
        If a coordinate is beyond the range of float32.
    """
    import trimesh

    scene = trimesh.Scene()
    for part in parts:
        as_float32(part.vertices, path)
        geometry = _segments(part) if part.elements.shape[1] == 2 else _triangles(part)
        scene.add_geometry(geometry, geom_name=part.name, node_name=part.name)
    content: bytes = scene.export(file_type="glb", include_normals=True)
    with atomic_file(path) as partial:
        partial.write_bytes(content)


def _triangles(part: ColouredPart) -> Any:
    from trimesh import Trimesh
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    # Without a material viewers take the format's default, a mirror of metal, in which colours are hard to read.
    material = PBRMaterial(
        name=part.name,
        baseColorFactor=[255, 255, 255, 255],
        metallicFactor=0.0,
        roughnessFactor=ROUGHNESS,
        alphaMode="BLEND" if part.translucent else "OPAQUE",
        doubleSided=part.name != "balls",
    )
    visual = TextureVisuals(material=material)
    visual.vertex_attributes["color"] = to_linear(part.colours)
    return Trimesh(part.vertices, part.elements, vertex_normals=part.normals, visual=visual, process=False)


def _segments(part: ColouredPart) -> Any:
    from trimesh.path import Path3D
    from trimesh.path.entities import Line

    return Path3D([Line(pair) for pair in part.elements], part.vertices, process=False)


def to_linear(colours: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Return ``(N, 4)`` sRGB colours with opacity as the linear ones that glTF has at vertices; opacity stays.

    Notes
    -----
    The transfer function of IEC 61966-2-1:1999.
    """
    encoded = colours[:, :3] / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return np.concatenate([np.round(255 * linear).astype(np.uint8), colours[:, 3:]], axis=1)
