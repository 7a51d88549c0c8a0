"""The camera as a renderer is told of it, where that measures the field of view along another side of the image."""

from __future__ import annotations

from math import atan, degrees, radians, tan
from typing import TYPE_CHECKING, Literal

from raytruth.scenes.camera import PerspectiveCamera

if TYPE_CHECKING:
    from raytruth.scenes.camera import Camera

FieldOfView = Literal["vertical", "horizontal", "larger side", "smaller side"]


def is_horizontal(field_of_view: FieldOfView, camera: Camera) -> bool:
    """Whether the image's width is the side that the field of view belongs to."""
    if field_of_view in {"vertical", "horizontal"}:
        return field_of_view == "horizontal"
    is_wider = camera.width > camera.height
    return is_wider if field_of_view == "larger side" else camera.width < camera.height


def handed_camera(field_of_view: FieldOfView, camera: Camera) -> Camera:
    """The same camera for who takes its number for the angle of that side: in degrees, rounded to float64.

    tan(h/2) = tan(v/2)·W/H, since the image plane is at one distance. Of parallel rays nothing changes.
    """
    if not isinstance(camera, PerspectiveCamera) or not is_horizontal(field_of_view, camera):
        return camera
    half = atan(tan(radians(camera.vertical_field_of_view) / 2) * camera.width / camera.height)
    return camera.model_copy(update={"vertical_field_of_view": degrees(2 * half)})
