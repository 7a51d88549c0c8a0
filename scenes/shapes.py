"""Shapes: spheres, triangles, meshes of triangles, and infinite planes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import ConfigDict, Field

from raytruth.scenes.values import Direction, Part, Positive, Vector

if TYPE_CHECKING:
    from pydantic.config import JsonDict

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


# What mesh_files.py checks, in words of JSON Schema.
_FILE_ALONE: JsonDict = {
    "required": ["file"],
    "properties": {"file": {"type": "string"}, "vertices": {"maxItems": 0}, "faces": {"maxItems": 0}},
}
_LISTS_ALONE: JsonDict = {
    "required": ["vertices", "faces"],
    "properties": {"file": {"type": "null"}, "vertices": {"minItems": 1}, "faces": {"minItems": 1}},
}


class Mesh(Part):
    """Triangles that share vertices, inline or from an OBJ or PLY file beside the scene; normals as in Triangle."""

    model_config = ConfigDict(json_schema_extra={"oneOf": [_FILE_ALONE, _LISTS_ALONE]})

    shape: Literal["mesh"]
    vertices: tuple[Vector, ...] = ()
    faces: tuple[tuple[VertexIndex, VertexIndex, VertexIndex], ...] = ()
    file: str | None = None
    material: str


class Plane(Part):
    """An infinite plane through a point; its surface normal is `normal` made a unit vector, the same everywhere."""

    shape: Literal["plane"]
    point: Vector
    normal: Direction
    """Of any length, which changes nothing. Glass fills the half space on the side that it points away from."""
    material: str


Shape = Annotated[Sphere | Triangle | Mesh | Plane, Field(discriminator="shape")]
