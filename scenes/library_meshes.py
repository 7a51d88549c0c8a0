"""Makes the mesh files of the scene library: `python -m raytruth.scenes.library_meshes` writes them anew."""

from __future__ import annotations

import math
from pathlib import Path

# Four decimals: the tube is 0.3 thick, so rounding moves it by less than a thousandth of its thickness.
DECIMALS = 4

Point = tuple[float, float, float]


def trefoil_knot(sections: int = 160, sides: int = 12, tube_radius: float = 0.31) -> str:
    """OBJ text of a closed tube around the trefoil knot (the torus knot with p = 2, q = 3), normals outward."""
    lines = ["# A tube around the trefoil knot; written by scenes/library_meshes.py"]
    for section in range(sections):
        for point in _ring(2 * math.pi * section / sections, sides, tube_radius):
            lines.append("v " + " ".join(f"{coordinate:.{DECIMALS}f}" for coordinate in point))
    for section in range(sections):
        for side in range(sides):
            here, above = section * sides, (section + 1) % sections * sides
            beside = (side + 1) % sides
            a, b, c, d = here + side + 1, here + beside + 1, above + beside + 1, above + side + 1
            lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    return "\n".join(lines) + "\n"


def _centre(t: float) -> Point:
    around = 0.43 * (2 + math.cos(3 * t))
    return around * math.cos(2 * t), around * math.sin(2 * t), 0.61 * math.sin(3 * t)


def _ring(t: float, sides: int, tube_radius: float) -> list[Point]:
    """The points of one cross-section, counterclockwise seen against the knot's direction."""
    step = 1e-4  # small against the knot's curvature, large against rounding
    centre = _centre(t)
    tangent = _unit(_minus(_centre(t + step), _centre(t - step)))
    # The knot runs around the z axis and never along it, so z gives the frame a direction that never flips.
    across = _unit(_cross((0.0, 0.0, 1.0), tangent))
    upward = _cross(tangent, across)
    points = []
    for side in range(sides):
        angle = 2 * math.pi * side / sides
        u, v = tube_radius * math.cos(angle), tube_radius * math.sin(angle)
        points.append(
            (
                centre[0] + u * across[0] + v * upward[0],
                centre[1] + u * across[1] + v * upward[1],
                centre[2] + u * across[2] + v * upward[2],
            )
        )
    return points


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Point, b: Point) -> Point:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _unit(a: Point) -> Point:
    length = math.hypot(*a)
    return a[0] / length, a[1] / length, a[2] / length


MESH_FILES = {"trefoil-knot.obj": trefoil_knot}


if __name__ == "__main__":
    for name, make in MESH_FILES.items():
        (Path(__file__).parent / "library" / name).write_text(make(), encoding="utf-8")
