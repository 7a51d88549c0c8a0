"""Right tracers that depart from the specification: the tracer's own source with the edits, in plain floats."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.departures import Departures
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.judgement.pixel_verdict import verdict_of
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32
from raytruth.reference_tracer.certified_image import certified_image
from raytruth.reference_tracer.rendering import prepare, render_prepared
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene, sphere, square

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.records.results import Verdict
    from raytruth.scenes.scene import Scene

# One bit for the last place of the mathematical library.
BITS = {"float64": 52, "float32": 23}
SIZE: dict[str, Any] = {"width": 12, "height": 9, "extent": 3.0}
# Far above rounding, and far enough to be seen.
OFFSET = RayOffset(absolute=0.125)

HIGHLIGHT = {"reflectance": (0.6, 0.6, 0.6), "exponent": 2.0, "model": "phong"}
SHINY = {"white": {"diffuse": {"reflectance": (0.4, 0.3, 0.2)}, "specular": HIGHLIGHT}}
BOARD = {"even": (0.9, 0.8, 0.7), "odd": (0.1, 0.2, 0.3), "size": 0.37, "plane": "xy", "offset": (0.11, 0.07)}


def _specular(**changes: Any) -> Scene:
    return small_scene(**SIZE, materials=SHINY, **changes)


SCENES: dict[str, Scene] = {
    "mirrors": library_scene("facing-mirrors-depth-2"),
    "sky": small_scene(
        **SIZE,
        materials={"white": {"mirror": {"reflectance": (0.9,) * 3}}},
        background={"bottom": (0.1, 0.2, 0.3), "top": (0.9, 0.8, 0.7)},
        objects=[sphere("white", (-0.7, 0.0, 0.0), 0.65), sphere("white", (0.7, 0.0, 0.0), 0.65)],
        max_depth=1,
    ),
    "glass": library_scene("glass-sphere"),
    "lit": library_scene("sphere-over-floor"),
    "board": small_scene(
        **SIZE,
        materials={"white": {"diffuse": {"reflectance": {"checkerboard": BOARD}}}},
        lights=[lamp((1.0, 2.0, 4.0))],
    ),
    "shadow": _specular(objects=[square("white", -1.5), sphere("white")], lights=[lamp((2.0, 1.0, 3.0))]),
    "behind": _specular(lights=[lamp((3.0, 0.0, -1.0))]),
    "lamps": library_scene("bright-lamps"),
}

DEPARTURES: dict[str, tuple[Departures, str, RayOffset]] = {
    "background at the end": (Departures(end_of_depth="background"), "sky", RayOffset()),
    "local terms at the end": (Departures(end_of_depth="local"), "mirrors", RayOffset()),
    "Schlick": (Departures(fresnel="schlick"), "glass", RayOffset()),
    "Schlick, incident": (Departures(fresnel="schlick on the incident side"), "glass", RayOffset()),
    "constant weights": (Departures(constant_weights=(0.1, 0.9)), "glass", RayOffset()),
    "lit from the offset point": (Departures(lit_from="offset point"), "lit", OFFSET),
    "textured at the offset point": (Departures(textured_at="offset point"), "board", OFFSET),
    "highlights in shadows": (Departures(highlights="shadowed"), "shadow", RayOffset()),
    "highlights everywhere": (Departures(highlights="everywhere"), "behind", RayOffset()),
    "clamped Lambert": (Departures(clamped_lambert=True), "lamps", RayOffset()),
}
"""Each departure with a scene where one sees it, and the ray offset of who has it."""


def model_of(departures: Departures, numbers: str, offset: RayOffset = RayOffset(), **declared: Any) -> ErrorModel:  # noqa: B008 - it is frozen
    return ErrorModel("simulated", BITS[numbers], offset, departures=departures, **declared)


def image_of(scene: Scene, model: ErrorModel, numbers: str) -> NDArray[np.float32]:
    """What a tracer computes that is as this model says, one rounding at a time."""
    arithmetic = FLOAT if numbers == "float64" else INTERPRETED_FLOAT32
    behaviour = behaviour_of(model, scene).with_numbers(lambda ball: arithmetic.number(float(ball.mid())))
    with np.errstate(all="ignore"):
        return np.asarray(render_prepared(prepare(scene, arithmetic, behaviour)), dtype=np.float32)


def judged(image: NDArray[np.float32], scene: Scene, declared: ErrorModel) -> tuple[Verdict, str]:
    rays = declared.camera_rays
    feasible = feasible_set(scene, declared, truth=certified_image(scene, rays))
    judgement, _ = judge_image(image, judged_truth(scene, rays), feasible)
    return verdict_of(judgement)
