"""The checks that need more than one part of a scene."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from raytruth.scenes.lights import PointLight
from raytruth.scenes.shapes import Mesh, Triangle
from raytruth.scenes.wording import place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from raytruth.scenes.camera import CameraBase
    from raytruth.scenes.lights import Light
    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape
    from raytruth.scenes.values import Color, Vector

# A picture and its first hits take 76 bytes a pixel (3 float32, 8 float64), so this is 1.3 GB: 4096 x 4096 pixels.
LARGEST_PIXEL_COUNT = 2**24

# Sine of the angle between `up` and the view; below it float32, whose unit roundoff is 6e-8, leaves the direction of
# the image's right side barely a digit. Decimal fractions that are meant to be parallel fall below it, too.
SMALLEST_SINE = 1e-6

# Shewchuk (1997), "Adaptive precision floating-point arithmetic", bound A of the test orient2d: (3 + 16 u) u with
# u = 2^-53, rounded up. It holds unless a product underflows, which the smallest normal number covers.
DETERMINANT_ERROR = 4 * 2.0**-53
SMALLEST_NORMAL = sys.float_info.min

Problem = tuple[str, str]
"""(place, sentence)"""


@dataclass(frozen=True)
class Parts:
    """The parts of a scene that are valid by themselves; where one is not, the others are checked all the same."""

    convention: str | None
    camera: CameraBase | None
    ambient_light: Color | None
    lights: Mapping[int, Light]
    materials: Mapping[str, Material]
    broken_materials: frozenset[str]
    """Names of materials that the file states, but not in a valid way."""
    objects: Mapping[int, Shape]


def parts_of(scene: Scene) -> Parts:
    """All parts of a valid scene."""
    return Parts(
        convention=scene.convention,
        camera=scene.camera,
        ambient_light=scene.ambient_light,
        lights=dict(enumerate(scene.lights)),
        materials=scene.materials,
        broken_materials=frozenset(),
        objects=dict(enumerate(scene.objects)),
    )


def inconsistencies(parts: Parts) -> list[Problem]:
    """Every contradiction between the parts; meshes must hold their triangles already."""
    return [
        *_camera_problems(parts),
        *_material_name_problems(parts),
        *_convention_problems(parts),
        *_triangle_problems(parts),
    ]


def _camera_problems(parts: Parts) -> Iterator[Problem]:
    camera = parts.camera
    if camera is None:
        return
    if camera.width * camera.height > LARGEST_PIXEL_COUNT:
        yield (
            "camera",
            f"expected at most {LARGEST_PIXEL_COUNT} pixels, whose results take 1.3 GB of memory, "
            f"found {camera.width} x {camera.height}; make width or height smaller.",
        )
    if camera.position == camera.look_at:
        yield "camera.look_at", "expected a point other than the camera's position, since both give the view direction."
    elif _nearly_parallel(_difference(camera.look_at, camera.position), _exact(camera.up)):
        yield (
            "camera.up",
            "expected a vector that is not parallel to the view from position to look_at, found one that is; "
            "choose another, such as [0, 0, 1] for a view straight down.",
        )
    if camera.inside is not None:
        yield from _dielectric_name_problems(parts, "camera.inside", camera.inside)


def _material_name_problems(parts: Parts) -> Iterator[Problem]:
    for index, shape in parts.objects.items():
        if shape.material not in parts.materials and shape.material not in parts.broken_materials:
            yield f"objects[{index}].material", _unknown_material(parts, shape.material)
    for name, material in parts.materials.items():
        if material.dielectric is None or material.dielectric.outside is None:
            continue
        where = place(("materials", name, "dielectric", "outside"))
        yield from _dielectric_name_problems(parts, where, material.dielectric.outside)
        if _surrounds_itself(parts, name):
            yield where, "expected media that end in empty space, found a medium that is outside of itself."


def _dielectric_name_problems(parts: Parts, where: str, name: str) -> Iterator[Problem]:
    if name in parts.broken_materials:
        return
    if name not in parts.materials:
        yield where, _unknown_material(parts, name)
    elif parts.materials[name].dielectric is None:
        dielectrics = [key for key, material in parts.materials.items() if material.dielectric is not None]
        yield (
            where,
            f"expected the name of a material with a dielectric, but {quoted(name)} has none; "
            f"{suggestion(name, dielectrics)}",
        )


def _unknown_material(parts: Parts, name: str) -> str:
    known = [*parts.materials, *parts.broken_materials]
    return f"expected the name of one of the scene's materials, found {quoted(name)}; {suggestion(name, known)}"


def _surrounds_itself(parts: Parts, name: str) -> bool:
    seen: set[str] = set()
    outside: str | None = name
    while outside is not None and outside not in seen:
        seen.add(outside)
        material = parts.materials.get(outside)
        outside = material.dielectric.outside if material is not None and material.dielectric is not None else None
    return outside == name


def _convention_problems(parts: Parts) -> Iterator[Problem]:
    if parts.convention != "radiometric":
        return
    for where, what in _classical_terms(parts):
        yield (
            where,
            f"expected no {what} in the radiometric convention, which has none; remove it, "
            "or set convention to 'whitted'.",
        )


def _classical_terms(parts: Parts) -> Iterator[Problem]:
    """(place, name) of each term that only the classical equation has."""
    if parts.ambient_light is not None and any(parts.ambient_light):
        yield "ambient_light", "ambient light"
    for index, light in parts.lights.items():
        if isinstance(light, PointLight) and light.falloff != "inverse_square":
            yield f"lights[{index}].falloff", "falloff other than 'inverse_square'"
    for name, material in parts.materials.items():
        for key, term in material.terms().items():
            if term.is_classical:
                yield place(("materials", name, key)), f"{key} term"
        if material.dielectric is not None and material.dielectric.reflectance is not None:
            yield place(("materials", name, "dielectric", "reflectance")), "constant reflectance and transmittance"


def _triangle_problems(parts: Parts) -> Iterator[Problem]:
    for index, shape in parts.objects.items():
        if isinstance(shape, Triangle) and _has_no_area(*shape.vertices):
            yield f"objects[{index}].vertices", "expected three vertices that span an area, found them on one line."
        elif isinstance(shape, Mesh):
            yield from _mesh_problems(shape, f"objects[{index}]")


def _mesh_problems(mesh: Mesh, where: str) -> Iterator[Problem]:
    for index, face in enumerate(mesh.faces):
        if max(face) >= len(mesh.vertices):
            yield (
                f"{where}.faces[{index}]",
                f"expected vertex numbers from 0 to {len(mesh.vertices) - 1}, found {max(face)}.",
            )
        elif _has_no_area(*(mesh.vertices[vertex] for vertex in face)):
            what = "expected three vertices that span an area, found them on one line."
            if mesh.file is None:
                yield f"{where}.faces[{index}]", what
            else:
                of_file = f"{quoted(mesh.file)} triangle {index} of vertices {list(face)}, both counted from 0"
                yield f"{where}.file", f"{of_file}: {what}"


def _has_no_area(first: Vector, second: Vector, third: Vector) -> bool:
    """Whether the area is exactly zero: rounding neither makes nor hides such a triangle."""
    return not _surely_has_area(first, second, third) and _are_parallel(
        _difference(second, first), _difference(third, first)
    )


def _surely_has_area(first: Vector, second: Vector, third: Vector) -> bool:
    """Decides in floats what their rounding cannot change, since rational arithmetic takes 50 times as long."""
    a = [q - p for p, q in zip(first, second, strict=True)]
    b = [q - p for p, q in zip(first, third, strict=True)]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        left, right = a[i] * b[j], a[j] * b[i]
        if abs(left - right) > DETERMINANT_ERROR * (abs(left) + abs(right)) + SMALLEST_NORMAL:
            return True
    return False


def _are_parallel(a: tuple[Fraction, ...], b: tuple[Fraction, ...]) -> bool:
    return a[0] * b[1] == a[1] * b[0] and a[1] * b[2] == a[2] * b[1] and a[2] * b[0] == a[0] * b[2]


def _nearly_parallel(a: tuple[Fraction, ...], b: tuple[Fraction, ...]) -> bool:
    cross = (a[0] * b[1] - a[1] * b[0], a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2])
    return _square(cross) <= Fraction(SMALLEST_SINE) ** 2 * _square(a) * _square(b)


def _square(a: tuple[Fraction, ...]) -> Fraction:
    return sum((component**2 for component in a), start=Fraction(0))


def _exact(vector: Vector) -> tuple[Fraction, ...]:
    return tuple(Fraction(component) for component in vector)


def _difference(a: Vector, b: Vector) -> tuple[Fraction, ...]:
    return tuple(Fraction(p) - Fraction(q) for p, q in zip(a, b, strict=True))
