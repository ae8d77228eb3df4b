"""Write coloured parts as a Wavefront OBJ file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from morphoskel.atomic import atomic_file
from morphoskel.exporting.coloured_parts import ColouredPart
from morphoskel.exporting.single_precision import as_float32


def write_coloured_obj(path: Path, parts: Sequence[ColouredPart]) -> None:
    """Write each part as an object of its own, which viewers can hide.

    Colours follow the coordinates of a vertex (``v x y z r g b``), an extension that Blender, MeshLab, Open3D and
    trimesh read and others ignore. Opacity, which it has no place for, is lost.

    Parameters
    ----------
    path
        File to write.
    parts
        Triangles become faces with a normal at each corner, segments become lines.

    Raises
    ------
    InputError
        If a coordinate is beyond the range of float32.
    """
    with atomic_file(path) as partial, partial.open("w", encoding="ascii", newline="\n") as stream:
        stream.write("# Written by MorphoSkel; vertices with colours: v x y z red green blue\n")
        vertices = normals = 0
        for part in parts:
            for line in _lines(part, vertices, normals, path):
                stream.write(line)
            vertices += len(part.vertices)
            normals += 0 if part.normals is None else len(part.normals)


def _lines(part: ColouredPart, vertices: int, normals: int, path: Path) -> Iterator[str]:
    """Yield the lines of one part; `vertices` and `normals` are the numbers of those before it in the file."""
    yield f"o {part.name}\n"
    places = as_float32(part.vertices, path).tolist()
    for (x, y, z), (red, green, blue, _) in zip(places, (part.colours / 255).tolist(), strict=True):
        yield f"v {x:.9g} {y:.9g} {z:.9g} {red:.4g} {green:.4g} {blue:.4g}\n"
    if part.normals is None:
        for first, second in (part.elements + vertices + 1).tolist():
            yield f"l {first} {second}\n"
        return
    for x, y, z in part.normals.tolist():
        yield f"vn {x:.5g} {y:.5g} {z:.5g}\n"
    shift = normals - vertices  # numbers count from 1 over the whole file
    for a, b, c in (part.elements + vertices + 1).tolist():
        yield f"f {a}//{a + shift} {b}//{b + shift} {c}//{c + shift}\n"
