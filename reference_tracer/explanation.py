"""The ray tree of one pixel, with every inner value.

The tracer's own source is run in Python floats, one ray of the tree at a time, while wrappers around its functions note
what they are given and what they return. No formula is written a second time, so what is explained is what the tracer
does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.explanation_record import DielectricTerm, Explanation, Hit, LightTerm, RayKind, TracedRay
from raytruth.reference_tracer.numbering import lights_as_traced, objects_of_primitives
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.source.scene_data import CAMERA_MEDIUM, MATERIAL_IS_LIT, integer_of
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.lights import PointLight, PolynomialFalloff
from raytruth.scenes.materials import Material

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reference_tracer.explanation_record import Falloff
    from raytruth.scenes.lights import Light
    from raytruth.scenes.scene import Scene

# A full binary tree of depth 11. No person reads more, and a tree of depth 64 would fill any memory.
MOST_RAYS = 4095

CHILD_KINDS: dict[str, RayKind] = {"reflected_ray": "reflected", "transmitted_ray": "transmitted"}
"""The functions that send rays on."""

RECORDED = (
    *CHILD_KINDS,
    *("nearest_hit", "surface_at", "material_of", "background_radiance", "medium_transmittance"),
    *("local_illumination", "attenuation", "direct_light"),
    *Material.model_fields,
    *("is_occluded", "distance_to_sphere", "nearest_triangle", "nearest_plane"),
    *("snell_discriminant", "fresnel_reflectance", "split", "total_reflection_weight"),
)
"""The functions of the tracer whose calls are noted, where a scene's kernel has them; most terms have one."""

LIGHT_TERM_KEYS = [key for key in Material.model_fields if key in LightTerm.model_fields]
"""Terms that an explanation of a light shows as the tracer's function of the same name gives them."""


class ExplanationError(Exception):
    """A pixel cannot be explained; the message is one sentence."""


@dataclass(frozen=True)
class _Call:
    """One call of a function of the tracer; calls that it makes itself are noted before it."""

    name: str
    arguments: tuple[Any, ...]
    result: Any


def explain(scene: Scene, x: int, y: int) -> Explanation:
    """The ray tree of the pixel in column `x` (from the left) and row `y` (from the top).

    The sum of the contributions equals, bit for bit, what `render` gives the pixel in Python floats. Raises
    ExplanationError for a pixel outside the image, and for a tree of more than MOST_RAYS rays.
    """
    camera = scene.camera
    if not (0 <= x < camera.width and 0 <= y < camera.height):
        raise ExplanationError(
            f"Pixel {x},{y} is outside the image of {scene.name}: "
            f"expected 0,0 (top left) to {camera.width - 1},{camera.height - 1}."
        )
    return _Tracing(scene).explanation(x, y)


class _Tracing:
    """A kernel for one scene whose calls are noted."""

    def __init__(self, scene: Scene) -> None:
        prepared = prepare(scene, FLOAT)
        self.scene = scene
        self.kernel = prepared.kernel
        self.data = prepared.data
        self.objects = objects_of_primitives(scene)
        self.materials = list(scene.materials)
        self.calls: list[_Call] = []
        functions = self.kernel.__dict__
        for name in RECORDED:
            if name in functions:
                functions[name] = _recorder(name, functions[name], self.calls)

    def explanation(self, x: int, y: int) -> Explanation:
        """Walk the tree as `radiance` does, with a stack of rays that wait."""
        scene, kernel = self.scene, self.kernel
        origin, direction = kernel.primary_ray(kernel.camera_frame(self.data), x + 0.5, y + 0.5)
        medium = integer_of(self.data, CAMERA_MEDIUM, 0)
        first = (origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, scene.max_depth)
        waiting: list[tuple[int | None, RayKind, Any]] = [(None, "camera", first)]
        rays: list[TracedRay] = []
        total = (0.0, 0.0, 0.0)
        while waiting:
            number = len(rays)
            if number == MOST_RAYS:
                raise ExplanationError(
                    f"Pixel {x},{y} of {scene.name} has more than {MOST_RAYS} rays: "
                    f"lower max_depth, which is {scene.max_depth}, to explain it."
                )
            parent, kind, ray = waiting.pop()
            self.calls.clear()
            sent_on: list[Any] = []
            contribution = kernel.trace_ray(self.data, ray, sent_on)
            total = kernel.add(total, contribution)
            rays.append(self._traced(number, parent, kind, ray, contribution))
            kinds = [CHILD_KINDS[call.name] for call in self.calls if call.name in CHILD_KINDS]
            waiting += [(number, child_kind, child) for child_kind, child in zip(kinds, sent_on, strict=True)]
        return Explanation(scene=scene.name, x=x, y=y, convention=scene.convention, sum=total, rays=tuple(rays))

    def _traced(self, number: int, parent: int | None, kind: RayKind, ray: Any, contribution: Any) -> TracedRay:
        """What the calls for one ray tell."""
        origin, direction, weight, left, medium, depth_left = ray
        results = {call.name: call.result for call in self.calls}
        hit = self._hit(results)
        material = None if hit is None else self.scene.materials[hit.material]
        return TracedRay(
            number=number,
            parent=parent,
            kind=kind,
            origin=origin,
            direction=direction,
            weight=weight,
            starts_on=None if left == NOTHING else left,
            medium=None if medium < 0 else self.materials[medium],
            depth_left=depth_left,
            hit=hit,
            background=results.get("background_radiance"),
            medium_transmittance=results.get("medium_transmittance"),
            emission=results.get("emission") if material and material.emission else None,
            ambient=results.get("ambient") if material and material.ambient else None,
            lights=self._light_terms(),
            local=results.get("local_illumination"),
            mirror_reflectance=material.mirror.reflectance if material and material.mirror else None,
            dielectric=_dielectric_term(self.calls),
            contribution=contribution,
        )

    def _hit(self, results: dict[str, Any]) -> Hit | None:
        distance, primitive = results["nearest_hit"]
        if primitive == NOTHING:
            return None
        point, normal, entering = results["surface_at"]
        return Hit(
            distance=distance,
            primitive=primitive,
            object_index=self.objects[primitive],
            material=self.materials[results["material_of"]],
            point=point,
            normal=normal,
            entering=entering,
        )

    def _light_terms(self) -> tuple[LightTerm, ...]:
        """One for each light, in the order in which the tracer adds them; none on a surface that is not lit."""
        terms: list[LightTerm] = []
        numbers = iter(lights_as_traced(self.scene))
        calls: list[_Call] = []
        for call in self.calls:
            calls.append(call)
            if call.name == "direct_light":
                number = next(numbers)
                if integer_of(self.data, MATERIAL_IS_LIT, call.arguments[2]):
                    terms.append(self._light_term(number, calls))
                calls = []
        return tuple(terms)

    def _light_term(self, number: int, calls: list[_Call]) -> LightTerm:
        """What the calls for one light tell; the last is `direct_light`."""
        _, _, material_row, _, normal, _, to_light, _, arriving = calls[-1].arguments
        results = {call.name: call.result for call in calls}
        light = self.scene.lights[number]
        material = self.scene.materials[self.materials[material_row]]
        specular = material.specular if "specular" in results else None
        occluder = _occluder(calls)
        return LightTerm(
            light=number,
            kind=light.kind,
            to_light=to_light,
            falloff=_falloff_name(light),
            attenuation=results.get("attenuation"),
            arriving=arriving,
            cosine=self.kernel.dot(normal, self.kernel.normalize(to_light)),
            shadowed=results.get("is_occluded"),
            occluder=occluder,
            occluder_object=None if occluder is None else self.objects[occluder],
            highlight=results["specular"] if specular else None,
            specular_reflectance=specular.reflectance if specular else None,
            specular_model=specular.model if specular else None,
            radiance=calls[-1].result,
            **{key: results.get(key) if key in material.terms() else None for key in LIGHT_TERM_KEYS},
        )


def _recorder(name: str, function: Callable[..., Any], calls: list[_Call]) -> Callable[..., Any]:
    def recorded(*arguments: Any) -> Any:
        result = function(*arguments)
        calls.append(_Call(name, arguments, result))
        return result

    return recorded


def _occluder(calls: list[_Call]) -> int | None:
    """The primitive that the last test before an `is_occluded` that says yes has found."""
    for place, call in enumerate(calls):
        if call.name == "is_occluded" and call.result:
            test = calls[place - 1]
            primitive: int = test.arguments[4] if test.name == "distance_to_sphere" else test.result[1]
            return primitive
    return None


def _dielectric_term(calls: list[_Call]) -> DielectricTerm | None:
    results = {call.name: call.result for call in calls}
    snell = next((call for call in calls if call.name == "snell_discriminant"), None)
    if snell is None:
        return None
    cosine, ratio = snell.arguments
    total = results.get("total_reflection_weight")
    reflected, transmitted = results["split"] if total is None else (total, None)
    return DielectricTerm(
        index_ratio=ratio,
        cosine=cosine,
        discriminant=snell.result,
        total_internal_reflection=total is not None,
        fresnel_reflectance=results.get("fresnel_reflectance"),
        reflected_weight=reflected,
        transmitted_weight=transmitted,
    )


def _falloff_name(light: Light) -> Falloff | None:
    if not isinstance(light, PointLight):
        return None
    return "polynomial" if isinstance(light.falloff, PolynomialFalloff) else light.falloff
