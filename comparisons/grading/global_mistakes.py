"""Mistakes that alter every pixel alike: a mirrored picture, a curve too many, another side of the field of view.

Each is undone as a convention is that a program declares: what moved is moved back, numbers are read for what they
are, and the truth is found for the rays and the camera that the program took. Then the rest of the picture can be
graded as if the mistake had not been made.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from math import atan, degrees, radians, tan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded
from raytruth.comparisons.renderers.program.conventions import CORNERS
from raytruth.reference_tracer.camera_rays import CENTRES, CameraRays
from raytruth.scenes.camera import PerspectiveCamera

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.scenes.scene import Scene

Array = NDArray[np.float64]
INTEGERS = {"uint8", "uint16"}
# With three there would be some hundreds of ways to take a picture, and more pictures that two of them explain.
MOST_AT_ONCE = 2


@dataclass(frozen=True)
class GlobalMistake:
    """One mistake, and how it is undone."""

    name: str
    words: str
    """One sentence, as a student would tell it."""
    hint: str
    """Where to look, without the solution."""
    kind: str
    """Of mistakes of one kind a program has one at most."""
    moved_back: Callable[[Array], Array] | None = None
    """From the picture's pixels to those that it should have, shape (height, width, 3)."""
    reread: Callable[[Array], Array] | None = None
    """From the linear values that were read to those that are read with the output model below."""
    output: Callable[[OutputModel], OutputModel | None] = lambda declared: declared
    """What was really written, by what is declared; None where a program that declares this cannot make the mistake."""
    written: Callable[[Array], Array] | None = None
    """What was done to the radiance before it was written; never falling."""
    scene: Callable[[Scene], Scene] | None = None
    """The scene that was rendered in place of the one asked for."""
    rays: CameraRays = CENTRES

    def __reduce__(self) -> tuple[Callable[[str], GlobalMistake], tuple[str]]:
        """Travels to other processes by its name, since its functions cannot."""
        return mistake_called, (self.name,)


def mistake_called(name: str) -> GlobalMistake:
    """The mistake of this name, one of GLOBAL_MISTAKES."""
    return next(mistake for mistake in GLOBAL_MISTAKES if mistake.name == name)


Reading = tuple[GlobalMistake, ...]
"""The mistakes that pictures are taken to have; none: they are taken as they are."""
AS_IT_IS: Reading = ()


def readings(declared: OutputModel) -> list[Reading]:
    """All ways to take the pictures of a program that declares this output, the fewest mistakes first."""
    possible = [mistake for mistake in GLOBAL_MISTAKES if mistake.output(declared) is not None]
    found: list[Reading] = [AS_IT_IS]
    for count in range(1, MOST_AT_ONCE + 1):
        for together in combinations(possible, count):
            kinds = {mistake.kind for mistake in together}
            if len(kinds) == count and output_of(together, declared) is not None:
                found.append(together)
    return found


def output_of(reading: Reading, declared: OutputModel) -> OutputModel | None:
    """What is written by a program with these mistakes; None where they do not go together."""
    output: OutputModel | None = declared
    for mistake in reading:
        output = None if output is None else mistake.output(output)
    return output


def needs_other_rays(reading: Reading) -> bool:
    """Whether the truth is another one than that of the scene's own image."""
    return any(mistake.scene is not None or mistake.rays != CENTRES for mistake in reading)


def rendered_scene(reading: Reading, scene: Scene) -> Scene:
    """The scene that a program with these mistakes has rendered."""
    for mistake in reading:
        scene = scene if mistake.scene is None else mistake.scene(scene)
    return scene


def rays_of(reading: Reading) -> CameraRays:
    """Through which points of the pixels its rays go."""
    return next((mistake.rays for mistake in reading if mistake.rays != CENTRES), CENTRES)


def corrected(reading: Reading, image: Array) -> Array:
    """The picture with the mistakes undone as far as pixels and numbers go."""
    for mistake in reading:
        for undo in (mistake.moved_back, mistake.reread):
            image = image if undo is None else undo(image)
    return image


def written_values(reading: Reading, radiance: Array) -> Array:
    """What a program with these mistakes hands to its output for these radiances."""
    for mistake in reading:
        radiance = radiance if mistake.written is None else mistake.written(radiance)
    return radiance


def _in_bytes(declared: OutputModel) -> OutputModel | None:
    if declared.numbers in INTEGERS or declared.numbers == "rgbe" or declared.scale != 1.0:
        return None
    return replace(declared, numbers="uint8", clipped=True)


def _bytes_as_floats(declared: OutputModel) -> OutputModel | None:
    return None if declared.transfer != "linear" else _in_bytes(declared)


def _scaled(declared: OutputModel) -> OutputModel | None:
    if declared.numbers in INTEGERS or declared.transfer != "linear":
        return None
    return replace(declared, scale=255.0)


def _encoded(declared: OutputModel) -> OutputModel | None:
    is_linear = declared.transfer == "linear" and declared.numbers != "rgbe"
    return replace(declared, transfer="sRGB") if is_linear and declared.scale == 1.0 else None


def _not_encoded(declared: OutputModel) -> OutputModel | None:
    return replace(declared, transfer="linear") if declared.transfer == "sRGB" else None


def _only_if_encoded(declared: OutputModel) -> OutputModel | None:
    return declared if declared.transfer == "sRGB" else None


def _only_if_linear(declared: OutputModel) -> OutputModel | None:
    return declared if declared.transfer == "linear" else None


def _other_side(scene: Scene) -> Scene:
    """The scene whose vertical angle is what the picture's height has where its width has the angle that is stated."""
    camera = scene.camera
    if not isinstance(camera, PerspectiveCamera) or camera.width == camera.height:
        return scene
    half = atan(tan(radians(camera.vertical_field_of_view) / 2) * camera.height / camera.width)
    changed = camera.model_copy(update={"vertical_field_of_view": degrees(2 * half)})
    return scene.model_copy(update={"camera": changed, "name": f"{scene.name}-other-side"})


def _channels(order: tuple[int, int, int]) -> Callable[[Array], Array]:
    """Puts each channel back that was written in the place `order` tells."""
    places = np.argsort(order)
    return lambda image: image[..., places]


def _half_pixels() -> Iterator[GlobalMistake]:
    for corner, (x, y) in CORNERS.items():
        if corner != "centre":
            words = f"Rays go through the {corner} corners of pixels instead of their centres."
            hint = "Where in a pixel does its ray go through the image?"
            yield GlobalMistake(f"half_a_pixel_{corner.replace(' ', '_')}", words, hint, "pixel", rays=CameraRays(x, y))


def _exchanged() -> Iterator[GlobalMistake]:
    for order in ((2, 1, 0), (1, 0, 2), (0, 2, 1), (1, 2, 0), (2, 0, 1)):
        written = "".join("RGB"[channel] for channel in order)
        words = f"Channels are written in the order {written}."
        hint = "In which order does the file format store the channels?"
        yield GlobalMistake(f"channels_as_{written}", words, hint, "channels", _channels(order))


GLOBAL_MISTAKES: tuple[GlobalMistake, ...] = (
    GlobalMistake(
        "mirrored",
        "Left and right are exchanged.",
        "Which way does the cross product of forward and up point?",
        "columns",
        lambda image: image[:, ::-1],
    ),
    GlobalMistake(
        "upside_down", "The picture stands on its head.", "Where is row 0?", "rows", lambda image: image[::-1]
    ),
    *_exchanged(),
    GlobalMistake(
        "curve_in_a_linear_file",
        "The curve of sRGB is applied before a linear file is written.",
        "What does a reader of this file expect its numbers to mean?",
        "values",
        reread=srgb_decoded,
        output=_encoded,
    ),
    GlobalMistake(
        "curve_forgotten",
        "Linear values are written to a file that is read as sRGB.",
        "What does an image viewer do to the values of such a file?",
        "values",
        reread=srgb_encoded,
        output=_not_encoded,
    ),
    GlobalMistake(
        "curve_twice",
        "The curve of sRGB is applied twice.",
        "How often is the curve applied on the way to the file?",
        "values",
        written=lambda radiance: srgb_encoded(np.clip(radiance, 0.0, 1.0)),
        output=_only_if_encoded,
    ),
    GlobalMistake(
        "power_in_a_linear_file",
        "The power 1/2.2 is applied before a linear file is written.",
        "What does a reader of this file expect its numbers to mean?",
        "values",
        written=lambda radiance: np.maximum(radiance, 0.0) ** (1.0 / 2.2),
        output=_only_if_linear,
    ),
    GlobalMistake(
        "eight_bits",
        "Values are rounded to 256 steps before floats are written.",
        "How many different values has your picture?",
        "numbers",
        output=_in_bytes,
    ),
    GlobalMistake(
        "codes_for_values",
        "Codes from 0 to 255 are written where values from 0 to 1 are due.",
        "How large is white in your file?",
        "numbers",
        reread=lambda image: image / 255.0,
        output=_bytes_as_floats,
    ),
    GlobalMistake(
        "times_255",
        "Values are multiplied by 255.",
        "How large is white in your file?",
        "numbers",
        reread=lambda image: image / 255.0,
        output=_scaled,
    ),
    GlobalMistake(
        "other_side_of_the_field_of_view",
        "The vertical field of view is taken for the horizontal one.",
        "Between which two edges of the image is the field of view measured?",
        "camera",
        scene=_other_side,
    ),
    *_half_pixels(),
)
