"""Shapes: spheres, triangles, and meshes of triangles."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from raytruth.scenes.values import Part, Positive, Vector

VertexIndex = Annotated[int, Field(strict=True, ge=0)]


class Sphere(Part):
    """A sphere; its surface normal points outward."""

    shape: Literal["sphere"]
    center: Vector
    radius: Positive
    material: str


class Triangle(Part):
    """A triangle; its surface normal points to the side from which the vertices run counterclockwise."""

    shape: Literal["triangle"]
    vertices: tuple[Vector, Vector, Vector]
    material: str


class Mesh(Part):
    """Triangles that share vertices, inline or from an OBJ or PLY file beside the scene; normals as in Triangle."""

    shape: Literal["mesh"]
    vertices: tuple[Vector, ...] = ()
    faces: tuple[tuple[VertexIndex, VertexIndex, VertexIndex], ...] = ()
    file: str | None = None
    material: str


Shape = Annotated[Sphere | Triangle | Mesh, Field(discriminator="shape")]
