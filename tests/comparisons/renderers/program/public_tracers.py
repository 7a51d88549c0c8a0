"""Six tracers with the conventions, models and mistakes of public ones, run as programs of a user.

`python -m tests.comparisons.renderers.program.public_tracers NAME MISTAKE SCENE OUTPUT` renders a scene file with one
of the tracer's mistakes, or with none (`mended`), and writes a PFM, or a PPM where the output is called so. The physics
is the tracer's own source with edits, in interpreted floats; the pixels' rays, the angle and the picture's order are
computed here as each does it.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from math import atan, degrees, radians, tan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.departures import NONE, Departures
from raytruth.comparisons.error_models.error_model import ErrorModel, TriangleTest
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from raytruth.reference_tracer.arithmetics.edits import Edit, edited
from raytruth.reference_tracer.rendering import prepare
from raytruth.scenes.camera import PerspectiveCamera
from raytruth.scenes.loading import load_scene

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Tracer:
    """What a program does, and what its author can truthfully declare of it."""

    declares: dict[str, Any]
    mistakes: Mapping[str, Mapping[str, tuple[Edit, ...]]]
    """What is edited in which function, by the mistake's name."""
    numbers: str = "float64"
    rays: RayOffset = RayOffset()  # noqa: RUF009 - it is frozen
    shadow_rays: RayOffset | None = None
    """Where they leave otherwise than all others."""
    triangle_test: TriangleTest = "watertight"
    departures: Departures = NONE
    angle_of: str = "height"
    """The side of the picture that it takes the scene's angle for."""
    less: int = 0
    """Taken from width and height where a pixel's size is computed."""
    within: tuple[float, float] = (0.5, 0.5)
    """Where in a pixel its ray goes through, from the corner where its rows and columns begin."""
    mirrored: bool = False
    bottom_first: bool = False
    scale: float = 1.0
    clamped: bool = False


FLOAT32 = {"precision": "float32", "slack_bits": 1}
"""A bit for NumPy's tangent."""

SHADOWED = "is_shadowed(scene, primitive, point, normal, to_light, light_is_near)"
ADD_DIFFUSE = "reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))"
MIRRORED = "along(direction, normal, -2.0 * dot(direction, normal))"

TRACERS = {
    "tiny": Tracer(
        {"arithmetic": FLOAT32, "rays": {"least_distance": 1e-3}, "model": {"end_of_depth": "background"}},
        {},
        numbers="float32",
        rays=RayOffset(minimum_distance=1e-3, excludes_surface=False),
        departures=Departures(end_of_depth="background"),
    ),
    "lesson": Tracer(
        {
            "arithmetic": FLOAT32,
            "rays": {"offset": 1e-5, "shadow_aim": "light"},
            "formulas": {"triangle": "moeller-trumbore"},
        },
        {
            "highlights in shadows": {
                "direct_light": (
                    Edit(f"if {SHADOWED}:\n    return (0.0, 0.0, 0.0)", ""),
                    Edit(ADD_DIFFUSE, f"if not {SHADOWED}:\n    {ADD_DIFFUSE}"),
                )
            }
        },
        numbers="float32",
        rays=RayOffset(absolute=1e-5),
        triangle_test="moeller-trumbore of 1997",
    ),
    "literate": Tracer(
        {
            "conventions": {
                "field_of_view": "horizontal",
                "pitch": "size less one",
                "pixel": "top left",
                "flip_y": True,
                "scale": 255.0,
            },
            "model": {"clamped_lambert": True},
        },
        {
            "mirrors look the other way": {"mirror_direction": (Edit(MIRRORED, f"negate({MIRRORED})"),)},
            "hits behind the start": {
                "sphere_distance": (
                    Edit("half_linear < 0.0", "half_linear != 0.0"),
                    Edit("foot > 0.0", "foot != 0.0"),
                )
            },
        },
        departures=Departures(clamped_lambert=True),
        angle_of="width",
        less=1,
        within=(0.0, 0.0),
        bottom_first=True,
        scale=255.0,
    ),
    "go": Tracer(
        {"model": {"end_of_depth": "local"}, "conventions": {"clamped_samples": True}},
        {
            "the same indices on leaving": {
                "index_ratio": (Edit("inside / outside if entering else outside / inside", "inside / outside"),)
            }
        },
        departures=Departures(end_of_depth="local"),
        clamped=True,
    ),
    "challenge": Tracer(
        {
            "rays": {"offset": 1e-7},
            "conventions": {"handedness": "left", "field_of_view": "larger side"},
            "model": {"fresnel": "schlick", "lit_from": "offset point", "textured_at": "offset point"},
        },
        {
            "a picture that grows with the tilt": {
                "camera_frame": (
                    Edit(
                        "normalize(cross(forward, vector_of(scene, CAMERA_UP, 0)))",
                        "cross(forward, normalize(vector_of(scene, CAMERA_UP, 0)))",
                    ),
                )
            },
            "a reflection for each light": {
                "trace_ray": (
                    Edit(
                        "multiply(weight, vector_of(scene, MATERIAL_MIRROR, material))",
                        "scale(multiply(weight, vector_of(scene, MATERIAL_MIRROR, material)), "
                        "float(rows_of(scene, LIGHT_POSITION)))",
                    ),
                )
            },
        },
        rays=RayOffset(absolute=1e-7),
        departures=Departures(fresnel="schlick", lit_from="offset point", textured_at="offset point"),
        angle_of="larger",
        mirrored=True,
    ),
    "java": Tracer(
        {
            "arithmetic": FLOAT32,
            "rays": {
                "least_distance": 1e-6,
                "shadow": {"offset": 1e-3, "least_distance": 0.0, "own_surface": "tested"},
                "shadow_aim": "light",
            },
            "conventions": {"pixel": "top left"},
        },
        {
            "highlights as the camera would see them": {
                "direct_light": (
                    Edit(
                        "specular(scene, material, normal, direction, toward_light)",
                        "specular(scene, material, normal, "
                        "normalize(subtract(point, vector_of(scene, CAMERA_POSITION, 0))), toward_light)",
                    ),
                )
            }
        },
        numbers="float32",
        rays=RayOffset(minimum_distance=1e-6, excludes_surface=False),
        shadow_rays=RayOffset(absolute=1e-3, excludes_surface=False),
        within=(0.0, 0.0),
    ),
}


def main() -> None:
    """Render as the arguments say."""
    name, mistake, scene_file, output = sys.argv[1:]
    image = picture(TRACERS[name], load_scene(scene_file), mistake)
    height, width, _ = image.shape
    with Path(output).open("wb") as file:
        if output.endswith(".ppm"):
            file.write(b"P6 %d %d 255\n" % (width, height))
            file.write(
                (np.clip(image, 0.0, 1.0) * np.float32(255.0)).astype(np.uint8).tobytes()
            )  # cut off, not rounded
        else:
            file.write(b"PF %d %d -1.0\n" % (width, height))
            file.write(image[::-1].tobytes())  # a PFM begins with its lowest row


def picture(tracer: Tracer, scene: Scene, mistake: str) -> NDArray[np.float32]:
    """The program's picture as it lies in its file, row by row from the top."""
    camera = scene.camera
    assert isinstance(camera, PerspectiveCamera)
    by_width = tracer.angle_of == "width" or (tracer.angle_of == "larger" and camera.width > camera.height)
    if by_width:
        half = atan(tan(radians(camera.vertical_field_of_view) / 2) * camera.height / camera.width)
        told = camera.model_copy(update={"vertical_field_of_view": degrees(2 * half)})
        scene = scene.model_copy(update={"camera": told})
    arithmetic = FLOAT if tracer.numbers == "float64" else INTERPRETED_FLOAT32
    model = ErrorModel(
        "",
        53,
        tracer.rays,
        shadow_offset=tracer.shadow_rays,
        triangle_test=tracer.triangle_test,
        departures=tracer.departures,
    )
    behaviour = behaviour_of(model, scene).with_numbers(lambda ball: arithmetic.number(float(ball.mid())))
    edits = {} if mistake == "mended" else tracer.mistakes[mistake]
    wrong = {function: edited(function, *those) for function, those in edits.items()}
    prepared = prepare(scene, arithmetic, merged(behaviour, Behaviour(wrong, name=mistake)))
    frame = prepared.kernel.camera_frame(prepared.data)
    image = np.empty((camera.height, camera.width, 3), dtype=np.float32)
    for row in range(camera.height):
        for column in range(camera.width):
            x = (column + tracer.within[0]) * camera.width / (camera.width - tracer.less)
            y = (row + tracer.within[1]) * camera.height / (camera.height - tracer.less)
            x = camera.width - x if tracer.mirrored else x
            y = camera.height - y if tracer.bottom_first else y
            color = prepared.kernel.radiance_at(prepared.data, frame, arithmetic.number(x), arithmetic.number(y))
            image[row, column] = [channel * tracer.scale for channel in color]
    return np.minimum(image, np.float32(1.0)) if tracer.clamped else image


if __name__ == "__main__":
    with np.errstate(all="ignore"):
        main()
