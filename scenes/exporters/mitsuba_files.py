"""The files that lie beside a Mitsuba scene file: meshes and environment maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.scenes.lights import GradientBackground
    from raytruth.scenes.materials import Checkerboard

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
    """A PLY file as text with vertices (n, 3), faces (m, 3) and texture coordinates (n, 2). Raises OSError.

    In float32, since Mitsuba keeps no more: nine digits name a float32 exactly.
    """
    names = "xyz" if coordinates is None else "xyzuv"
    columns = vertices if coordinates is None else np.hstack([vertices, coordinates])
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n")
        file.writelines(f"property float {name}\n" for name in names)
        file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        np.savetxt(file, columns.astype(np.float32), fmt="%.9g")
        np.savetxt(file, np.insert(faces, 0, 3, axis=1), fmt="%d")
