"""Scenes in which a ray offset shows, and a tracer that has what an error model says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare, render_prepared
from raytruth.scenes.scene import Scene

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel

FAR = (0.0, 2.0, 8.0)
"""Where the scenes are, so that offsets may depend on coordinates. The largest of the floor's corners is 8.4."""


def at(x: float, y: float, z: float) -> list[float]:
    return [x + FAR[0], y + FAR[1], z + FAR[2]]


def low_things(kind: str, height: float, *, infinite: bool = False) -> Scene:
    """A floor, and beside or below it what a ray of this kind meets so near that a longer offset passes it by.

    The floor, which may be an infinite plane, is in the shadow of a wall, or mirrors it, or lets one see a plate below.
    """
    half, low = 0.4, -height / 2
    floor = [at(-half, 0, half), at(half, 0, half), at(0, 0, -half)]
    wall = [at(low, 0, -half), at(low, 0, half), at(low, height, half), at(low, height, -half)]
    plate = [at(-half, low, -half), at(-half, low, half), at(half, low, half), at(half, low, -half)]
    surfaces = {
        "shadow": {"diffuse": {"reflectance": [0.7] * 3}},
        "reflected": {"mirror": {"reflectance": [0.9] * 3}},
        "refracted": {"dielectric": {"index_of_refraction": 1.25}},
    }
    camera = {
        **{"projection": "orthographic", "position": at(0.6, 1, 0.2), "look_at": at(0, 0, 0), "up": [0, 0, -1]},
        **{"view_height": height / 4, "width": 4, "height": 3},
    }
    materials = {"floor": surfaces[kind], "glowing": {"emission": {"radiance": [1, 1, 1]}}}
    return Scene.model_validate(
        {
            **{"purpose": "A test.", "convention": "radiometric", "max_depth": 1, "camera": camera},
            "lights": [{"kind": "directional", "direction": [1, -1, 0.1], "irradiance": [3, 3, 3]}],
            "materials": materials,
            "objects": [
                {"shape": "plane", "point": at(0, 0, 0), "normal": [0, 1, 0], "material": "floor"}
                if infinite
                else {"shape": "triangle", "vertices": floor, "material": "floor"},
                {
                    **{"shape": "mesh", "faces": [[0, 1, 2], [0, 2, 3]], "material": "glowing"},
                    "vertices": plate if kind == "refracted" else wall,
                },
            ],
        }
    )


def program(scene: Scene, model: ErrorModel) -> Any:
    """What a tracer in float64 that has what the model says gives: each constant is the middle of its ball."""
    behaviour = behaviour_of(model, scene).with_numbers(lambda ball: float(ball.mid()))
    return render_prepared(prepare(scene, FLOAT, behaviour)).astype(float)
