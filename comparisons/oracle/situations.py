"""From a question to the smallest scene in which the tracer's own source answers it.

No formula is written here: a ray meets the only shape of a scene, a surface sends one ray on, a camera gives one ray.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.feasible_sets.rounded_rays import first_hit
from raytruth.comparisons.oracle.questions import (
    Fresnel,
    IntersectBox,
    IntersectPlane,
    IntersectSphere,
    IntersectTriangle,
    PrimaryRay,
    Question,
    Reflect,
    Refract,
    Shade,
)
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, edited
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.camera import PerspectiveCamera
from raytruth.scenes.features import Feature
from raytruth.scenes.materials import Dielectric, Emission, Material, Mirror
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Plane, Shape, Sphere, Triangle

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.rendering import PreparedScene

Found = dict[str, Any]
"""By name: a truth value, a number of the arithmetic in force, or a tuple of three."""
Given = tuple[float, float, float]


@dataclass(frozen=True)
class Situation:
    """A scene, and what its kernel is asked."""

    scene: Scene
    ask: Callable[[PreparedScene], Found]
    more_features: frozenset[Feature] = frozenset()
    """What the kernel must have that the scene does not require."""


ORIGIN = (0.0, 0.0, 0.0)
UPWARD = (0.0, 0.0, 1.0)
ANY_CAMERA = PerspectiveCamera(
    projection="perspective",
    position=UPWARD,
    look_at=ORIGIN,
    width=1,
    height=1,
    vertical_field_of_view=45.0,
)
GLOWING = Material(emission=Emission(radiance=(1.0, 1.0, 1.0)))
"""Has no part in any answer."""
SLABS = Behaviour(
    {
        "box_is_missed": edited(
            "box_is_missed",
            Edit("return True", "return inf, -inf"),
            Edit("return certainly_less(leave, entry)", "return entry, leave"),
        ),
        "rounding_allowance": edited("rounding_allowance", Edit("return 6e-7", "return 0.0")),
    },
    name="the slabs of a box",
)
"""The source only asks whether a box, a little enlarged, is missed: here it tells where a box itself is met."""

CHANGES = {"intersect_box": SLABS}
"""What a kernel does otherwise than the source, by what is asked."""


def situation_of(question: Question) -> Situation:  # noqa: PLR0911 - one for each kind of question
    """The scene of a question, and how its answer is found there."""
    match question:
        case IntersectSphere():
            return _intersection(
                Sphere(shape="sphere", center=question.center, radius=question.radius, **_OF), question
            )
        case IntersectTriangle():
            corners = (question.a, question.b, question.c)
            return _intersection(Triangle(shape="triangle", vertices=corners, **_OF), question)
        case IntersectPlane():
            return _intersection(Plane(shape="plane", point=question.point, normal=question.normal, **_OF), question)
        case IntersectBox():
            return _box(question)
        case Reflect():
            return _reflection(question)
        case Refract():
            return _refraction(question.direction, question.normal, question, is_direction_told=True)
        case Fresnel():
            return _refraction((0.0, 0.0, -question.cosine), UPWARD, question, is_direction_told=False)
        case Shade():
            return _shading(question)
        case PrimaryRay():
            return _primary_ray(question)


_OF: dict[str, Any] = {"material": "surface"}


def _scene(material: Material, shape: Shape, **more: Any) -> Scene:
    stated: dict[str, Any] = {"convention": "whitted", "camera": ANY_CAMERA, "max_depth": 1} | more
    materials = {"surface": material, **stated.pop("further_materials", {})}
    return Scene(purpose="One step of a tracer.", materials=materials, objects=(shape,), **stated)


def _intersection(shape: Shape, question: IntersectSphere | IntersectTriangle | IntersectPlane) -> Situation:
    def ask(prepared: PreparedScene) -> Found:
        origin, direction = _numbers(prepared, question.origin), _numbers(prepared, question.direction)
        primitive, values = first_hit(prepared, origin, direction)
        if primitive == NOTHING:
            return {"hit": False}
        return {"hit": True, "distance": values[0], "point": values[1:4], "normal": values[4:7]}

    return Situation(_scene(GLOWING, shape), ask)


def _box(question: IntersectBox) -> Situation:
    corners = (ORIGIN, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

    def ask(prepared: PreparedScene) -> Found:
        ray_and_box = (question.origin, question.direction, question.low, question.high)
        functions = prepared.arithmetic.functions
        kernel: Any = prepared.kernel
        enter, leave = kernel.box_is_missed(*(_numbers(prepared, vector) for vector in ray_and_box), functions["inf"])
        if functions["is_less"](leave, enter):
            return {"hit": False}
        return {"hit": True, "enter": enter, "leave": leave}

    scene = _scene(GLOWING, Triangle(shape="triangle", vertices=corners, **_OF))
    return Situation(scene, ask, frozenset({Feature.BOUNDING_VOLUMES}))


def _reflection(question: Reflect) -> Situation:
    def ask(prepared: PreparedScene) -> Found:
        kernel: Any = prepared.kernel
        normal = kernel.normalize(_numbers(prepared, question.normal))
        return {"direction": kernel.mirror_direction(_numbers(prepared, question.direction), normal)}

    mirror = Material(mirror=Mirror(reflectance=(1.0, 1.0, 1.0)))
    return Situation(_scene(mirror, _plane(ORIGIN, question.normal)), ask)


def _refraction(direction: Given, normal: Given, question: Refract | Fresnel, *, is_direction_told: bool) -> Situation:
    """The rays that a surface sends on, as the tree of rays has them. Only unit directions make refracted ones."""
    turned = _turned(normal, direction)

    def ask(prepared: PreparedScene) -> Found:
        kernel: Any = prepared.kernel
        given, unit_normal = _numbers(prepared, direction), kernel.normalize(_numbers(prepared, turned))
        given = kernel.normalize(given) if is_direction_told else given
        number = prepared.arithmetic.number
        start = _numbers(prepared, ORIGIN)
        kernel.nearest_hit = lambda *_: (number(0.0), 0)
        kernel.surface_at = lambda *_: (start, unit_normal, True)
        white = _numbers(prepared, (1.0, 1.0, 1.0))
        sent_on: list[Any] = []
        kernel.trace_ray(prepared.data, (start, given, white, NOTHING, 1, 1), sent_on)
        return _sent_on(sent_on, is_direction_told=is_direction_told)

    beyond = Material(dielectric=Dielectric(index_of_refraction=question.index_to, outside="before"))
    before = {"before": Material(dielectric=Dielectric(index_of_refraction=question.index_from))}
    return Situation(_scene(beyond, _plane(ORIGIN, turned), further_materials=before), ask)


def _sent_on(rays: list[Any], *, is_direction_told: bool) -> Found:
    """The reflected ray, and behind it the refracted one unless reflection is total; each after its start."""
    (_, mirrored, reflectance, *_), *refracted = rays
    found: Found = {"total_reflection": not refracted, "reflectance": reflectance[0]}
    if is_direction_told:
        found["reflected"] = mirrored
    for _, direction, transmittance, *_ in refracted:
        found["transmittance"] = transmittance[0]
        if is_direction_told:
            found["refracted"] = direction
    return found


def _shading(question: Shade) -> Situation:
    turned = _turned(question.normal, question.direction)

    def ask(prepared: PreparedScene) -> Found:
        kernel: Any = prepared.kernel
        normal, direction = (kernel.normalize(_numbers(prepared, it)) for it in (turned, question.direction))
        point = _numbers(prepared, question.point)
        return {"color": kernel.local_illumination(prepared.data, 0, 0, point, normal, direction)}

    scene = _scene(
        question.material,
        _plane(question.point, turned),
        convention=question.convention,
        lights=question.lights,
        ambient_light=question.ambient_light,
    )
    return Situation(scene, ask)


def _primary_ray(question: PrimaryRay) -> Situation:
    column, row = question.pixel

    def ask(prepared: PreparedScene) -> Found:
        number = prepared.arithmetic.number
        frame = prepared.kernel.camera_frame(prepared.data)
        origin, direction = prepared.kernel.primary_ray(frame, number(column + 0.5), number(row + 0.5))
        return {"origin": origin, "direction": direction}

    return Situation(_scene(GLOWING, _plane(ORIGIN, UPWARD), camera=question.camera), ask)


def _plane(point: Given, normal: Given) -> Plane:
    return Plane(shape="plane", point=point, normal=normal, **_OF)


def _numbers(prepared: PreparedScene, vector: Given) -> tuple[Any, Any, Any]:
    x, y, z = map(prepared.arithmetic.number, vector)
    return x, y, z


def _turned(normal: Given, direction: Given) -> Given:
    """The normal on the side from which the ray comes, told without rounding."""
    cosine = sum(Fraction(a) * Fraction(b) for a, b in zip(normal, direction, strict=True))
    return (-normal[0], -normal[1], -normal[2]) if cosine > 0 else normal
