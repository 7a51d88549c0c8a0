"""What a scene is, and how it is read from its file (docs/scene-format.md)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import floor, pi, tan
from typing import TYPE_CHECKING, Any

from vectors import Vec, cross, dot, length, scale, subtract, unit

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    Texture = Callable[[Vec], Vec]

BLACK: Vec = (0.0, 0.0, 0.0)
CLUSTER_SIZE = 32
"""Triangles in a cluster: any number is right; about the square root of a few thousand triangles is quick."""


@dataclass(slots=True)
class Dielectric:
    """A smooth transparent interface."""

    index: float
    absorption: Vec | None
    reflectance: Vec | None
    transmittance: Vec | None
    outside: Material | None = None


@dataclass(slots=True)
class Material:
    """The terms that a material states."""

    ambient: Vec | None
    diffuse: Texture | None
    specular: Vec | None
    exponent: float
    is_blinn: bool
    mirror: Vec | None
    emission: Texture | None
    dielectric: Dielectric | None


@dataclass(slots=True, eq=False)
class Sphere:
    """All points at one distance from the centre."""

    center: Vec
    radius: float
    material: Material


@dataclass(slots=True, eq=False)
class Triangle:
    """A corner, and the way from it to the other two; the normal is the shape's own."""

    a: Vec
    ab: Vec
    ac: Vec
    normal: Vec
    material: Material


@dataclass(slots=True, eq=False)
class Plane:
    """All points of a plane; the normal is a unit vector."""

    point: Vec
    normal: Vec
    material: Material


@dataclass(slots=True)
class Cluster:
    """Triangles, and a sphere around them: a ray that misses it misses them all."""

    center: Vec
    radius: float
    triangles: Sequence[Triangle]


@dataclass(slots=True)
class Light:
    """A point light, or a directional one, which has a direction in place of a position."""

    position: Vec | None
    direction: Vec | None
    intensity: Vec
    falloff: Vec
    """The divisor is falloff[0] + falloff[1] · d + falloff[2] · d²."""
    is_clamped: bool


@dataclass(slots=True)
class Camera:
    """The camera's axes and the size of a pixel on its image plane."""

    position: Vec
    forward: Vec
    right: Vec
    down: Vec
    is_perspective: bool
    pixel: float
    width: int
    height: int
    inside: Material | None


@dataclass(slots=True)
class Scene:
    """All that a scene file states."""

    is_radiometric: bool
    max_depth: int
    camera: Camera
    bottom: Vec
    top: Vec
    ambient_light: Vec
    lights: list[Light]
    spheres: list[Sphere]
    clusters: list[Cluster]
    planes: list[Plane]


def load(path: Path) -> Scene:
    """Read a scene file; a key that it does not state, or states as null, has the default of the format."""
    stated = json.loads(path.read_text(encoding="utf-8"))
    background = stated.get("background") or {"color": BLACK}
    materials = _materials(stated["materials"])
    spheres = [
        Sphere(tuple(shape["center"]), shape["radius"], materials[shape["material"]])
        for shape in stated["objects"]
        if shape["shape"] == "sphere"
    ]
    planes = [
        Plane(tuple(shape["point"]), unit(shape["normal"]), materials[shape["material"]])  # PLANE-4
        for shape in stated["objects"]
        if shape["shape"] == "plane"
    ]
    triangles = [
        triangle
        for shape in stated["objects"]
        if shape["shape"] in {"triangle", "mesh"}
        for triangle in _triangles(shape, path.parent, materials[shape["material"]])
    ]
    return Scene(
        is_radiometric=stated["convention"] == "radiometric",
        max_depth=stated.get("max_depth") or 0,
        camera=_camera(stated["camera"], materials),
        bottom=tuple(background.get("color") or background["bottom"]),
        top=tuple(background.get("color") or background["top"]),
        ambient_light=tuple(stated.get("ambient_light") or BLACK),
        lights=[_light(light) for light in stated.get("lights") or ()],
        spheres=spheres,
        clusters=[_cluster(triangles[i : i + CLUSTER_SIZE]) for i in range(0, len(triangles), CLUSTER_SIZE)],
        planes=planes,
    )


def _camera(stated: dict[str, Any], materials: dict[str | None, Material]) -> Camera:
    forward = unit(subtract(stated["look_at"], stated["position"]))  # CAM-1
    right = unit(cross(forward, stated.get("up") or (0.0, 1.0, 0.0)))
    is_perspective = stated["projection"] == "perspective"
    # The height of the image plane: CAM-3 at the distance 1, CAM-4.
    view_height = 2 * tan(stated["vertical_field_of_view"] * pi / 360) if is_perspective else stated["view_height"]
    return Camera(
        position=tuple(stated["position"]),
        forward=forward,
        right=right,
        down=cross(forward, right),
        is_perspective=is_perspective,
        pixel=view_height / stated["height"],
        width=stated["width"],
        height=stated["height"],
        inside=materials.get(stated.get("inside")),
    )


def _light(stated: dict[str, Any]) -> Light:
    if stated["kind"] == "directional":
        return Light(None, unit(stated["direction"]), stated["irradiance"], (1, 0, 0), is_clamped=False)
    falloff = stated["falloff"]
    if isinstance(falloff, dict):
        factors = (falloff["constant"], falloff["linear"], falloff["quadratic"])
    else:
        factors = (1, 0, 0) if falloff == "none" else (0, 0, 1)
    return Light(stated["position"], None, stated["intensity"], factors, is_clamped=isinstance(falloff, dict))


def _materials(stated: dict[str, Any]) -> dict[str | None, Material]:
    materials: dict[str | None, Material] = {name: _material(material) for name, material in stated.items()}
    for name, material in materials.items():
        if material.dielectric is not None:
            material.dielectric.outside = materials.get(stated[name]["dielectric"].get("outside"))
    return materials


def _material(stated: dict[str, Any]) -> Material:
    terms = {name: stated.get(name) or {} for name in ("ambient", "diffuse", "specular", "mirror", "emission")}
    glass = stated.get("dielectric")
    return Material(
        ambient=terms["ambient"].get("reflectance"),
        diffuse=_texture(terms["diffuse"].get("reflectance")),
        specular=terms["specular"].get("reflectance"),
        exponent=terms["specular"].get("exponent", 1),
        is_blinn=terms["specular"].get("model") == "blinn",
        mirror=terms["mirror"].get("reflectance"),
        emission=_texture(terms["emission"].get("radiance")),
        dielectric=glass
        and Dielectric(
            glass["index_of_refraction"], glass.get("absorption"), glass.get("reflectance"), glass.get("transmittance")
        ),
    )


def _texture(stated: Any) -> Texture | None:
    """The colour at each point of a surface."""
    if not isinstance(stated, dict):
        return stated and (lambda _point: stated)
    board = stated["checkerboard"]
    axis_u, axis_v = ("xyz".index(axis) for axis in board.get("plane") or "xz")
    offset_u, offset_v = board.get("offset") or (0.0, 0.0)
    size = board.get("size") or 1.0

    def checkerboard(point: Vec) -> Vec:  # TEX-1, TEX-2
        squares = floor((point[axis_u] - offset_u) / size) + floor((point[axis_v] - offset_v) / size)
        return board["odd" if squares % 2 else "even"]

    return checkerboard


def _triangles(stated: dict[str, Any], folder: Path, material: Material) -> list[Triangle]:
    """The triangles of a triangle or a mesh; a face of more corners is a fan."""
    if stated.get("file"):
        vertices, faces = _read_obj(folder / stated["file"])
    else:
        vertices, faces = stated["vertices"], stated.get("faces") or ((0, 1, 2),)
    triangles = []
    for face in faces:
        a = vertices[face[0]]
        for i in range(2, len(face)):
            ab, ac = subtract(vertices[face[i - 1]], a), subtract(vertices[face[i]], a)
            triangles.append(Triangle(a, ab, ac, unit(cross(ab, ac)), material))  # TRI-4
    return triangles


def _read_obj(path: Path) -> tuple[list[Vec], list[list[int]]]:
    """The corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes."""
    vertices, faces = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        match line.split():
            case ["v", x, y, z, *_]:
                vertices.append((float(x), float(y), float(z)))
            case ["f", *corners]:  # 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
                numbers = [int(corner.split("/")[0]) for corner in corners]
                faces.append([number - 1 if number > 0 else number + len(vertices) for number in numbers])
    return vertices, faces


def _cluster(triangles: Sequence[Triangle]) -> Cluster:
    """A cluster of these triangles, neighbours in their mesh, with a sphere that surely holds them."""
    corners = [
        (t.a[0] + k * t.ab[0] + m * t.ac[0], t.a[1] + k * t.ab[1] + m * t.ac[1], t.a[2] + k * t.ab[2] + m * t.ac[2])
        for t in triangles
        for k, m in ((0, 0), (1, 0), (0, 1))
    ]
    center = scale(1 / len(corners), tuple(map(sum, zip(*corners, strict=True))))
    return Cluster(center, max(length(subtract(corner, center)) for corner in corners), triangles)


def may_meet(origin: Vec, direction: Vec, cluster: Cluster) -> bool:
    """Whether the line meets the cluster's sphere, or passes so near that rounding could hide it; a unit direction."""
    way = subtract(origin, cluster.center)
    across = cross(way, direction)  # as long as the line's distance from the centre
    # The errors of these few operations are below 1e-14 of the lengths in them; 1e-9 leaves room to spare.
    reach = cluster.radius + 1e-9 * (cluster.radius + length(way))
    return dot(across, across) <= reach * reach
