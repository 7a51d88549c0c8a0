"""The files that lie beside a Mitsuba scene file: meshes and environment maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
from plyfile import PlyData, PlyElement

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from scenes.lights import GradientBackground
    from scenes.materials import Checkerboard

# Mitsuba interpolates linearly in the angle θ from straight up between rows π/(rows-1) apart (envmap.cpp,
# `eval_spectrum`), where we mean (top+bottom)/2 + cosθ·(top-bottom)/2. The error of linear interpolation is at most
# step²/8·max|second derivative| = (π/4095)²/16·|top-bottom| = 3.7e-8·|top-bottom|, under 2^-24 = 6.0e-8.
GRADIENT_ROWS = 4096
GRADIENT_COLUMNS = 2  # the least that Mitsuba takes without padding


def write_gradient(path: Path, background: GradientBackground) -> None:
    """The gradient as an environment map in latitude and longitude, row 0 straight up. Raises OSError."""
    up = np.cos(np.linspace(0.0, np.pi, GRADIENT_ROWS))[:, None]
    rows = (0.5 - 0.5 * up) * background.bottom + (0.5 + 0.5 * up) * background.top
    pixels = np.repeat(rows[:, None, :], GRADIENT_COLUMNS, axis=1).astype(np.float32)
    buffer = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(GRADIENT_COLUMNS, GRADIENT_ROWS, 3, "float"))
    buffer.set_pixels(OpenImageIO.ROI.All, pixels)
    if not buffer.write(str(path)):
        raise OSError(f"{path}: cannot be written: {buffer.geterror()}")


def checkerboard_coordinates(checkerboard: Checkerboard, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Texture coordinates of vertices, shape (n, 2), whose unit is a period of two squares.

    The projection onto the plane is affine, so that interpolation between vertices reproduces it.
    """
    axes = ["xyz".index(axis) for axis in checkerboard.plane]
    offset = np.array(checkerboard.offset, dtype=np.float64)
    return (vertices[:, axes] - offset) / np.float64(2 * checkerboard.size)


def write_triangles(
    path: Path, vertices: NDArray[np.float64], faces: NDArray[np.int64], coordinates: NDArray[np.float64] | None
) -> None:
    """A PLY file as text with vertices (n, 3), faces (m, 3) and texture coordinates (n, 2).

    In float32, since Mitsuba keeps no more; plyfile prints 18 digits, which name a float32 exactly.
    """
    columns = dict(zip("xyz", vertices.T, strict=True))
    if coordinates is not None:
        columns |= dict(zip("uv", coordinates.T, strict=True))
    vertex = np.empty(len(vertices), dtype=[(name, "f4") for name in columns])
    for name, column in columns.items():
        vertex[name] = column
    face = np.empty(len(faces), dtype=[("vertex_indices", "i4", (3,))])
    face["vertex_indices"] = faces
    elements = [PlyElement.describe(vertex, "vertex"), PlyElement.describe(face, "face")]
    PlyData(elements, text=True).write(str(path))
