"""What mesh readers give back: vertices and triangular faces, within limits."""

from __future__ import annotations

from raytruth.scenes.values import LARGEST_COORDINATE

Vertices = tuple[tuple[float, float, float], ...]
Faces = tuple[tuple[int, int, int], ...]
TriangleLists = tuple[Vertices, Faces]

# As Python tuples a face and its share of the vertices take about 300 bytes: 150 MB for the largest mesh.
LARGEST_FACE_COUNT = 500_000


class MeshFileError(Exception):
    """A mesh file cannot be used; the message is one sentence without the file's name."""


def check_coordinate(value: float) -> float:
    """The coordinate itself, if it is finite and not absurdly large; raises MeshFileError."""
    # Written so that NaN fails, too.
    if not abs(value) <= LARGEST_COORDINATE:
        raise MeshFileError(f"expected a finite coordinate of at most {LARGEST_COORDINATE:g} in size, found {value}.")
    return value


def check_polygon(corners: tuple[int, ...]) -> None:
    """Raises MeshFileError unless a face has three different vertices or more."""
    if len(corners) < 3:
        raise MeshFileError(f"expected a face with at least three vertices, found {len(corners)}.")
    if len(set(corners)) < len(corners):
        raise MeshFileError("expected a face with each vertex once, found one again; remove the corner or the face.")


def check_face_count(count: int) -> None:
    """Raises MeshFileError if a mesh has too many triangles."""
    if count > LARGEST_FACE_COUNT:
        raise MeshFileError(
            f"has too many faces: expected at most {LARGEST_FACE_COUNT} triangles, which take about 150 MB of memory."
        )


def fan(polygon: tuple[int, ...]) -> Faces:
    """The triangles that a convex polygon is split into: all share its first vertex."""
    return tuple((polygon[0], polygon[i], polygon[i + 1]) for i in range(1, len(polygon) - 1))
