"""The camera as a renderer is told of it, where that measures the field of view along another side of the image."""

from __future__ import annotations

from math import atan, degrees, radians, tan
from typing import TYPE_CHECKING, Any, Literal

from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, edited
from raytruth.scenes.camera import PerspectiveCamera

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.scenes.camera import Camera
    from raytruth.scenes.scene import Scene

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


def camera_behaviour(error_model: ErrorModel, scene: Scene) -> Behaviour:
    """What this renderer's camera computes otherwise: its pixels' rays, and how it finds them from the angle told.

    The angle that it was told is a constant, a ball that holds what it stores: so what its rounding does to the rays is
    found from that angle, which may be larger, and not from the scene's.
    """
    camera = handed_camera(error_model.field_of_view, scene.camera)
    if camera == scene.camera:
        return error_model.camera_rays.behaviour()
    assert isinstance(camera, PerspectiveCamera), "a camera of parallel rays is handed as it is"
    from_angle = Edit("visible_height * pi / 360.0", "handed_angle * pi / 360.0")
    to_height = Edit("2.0 * tan(handed_angle * pi / 360.0)", "2.0 * tan(handed_angle * pi / 360.0) * height / width")
    frame = edited(
        "camera_frame", from_angle, to_height, *error_model.camera_rays.edits(), helpers=("handed_angle",)
    )
    angle: Any = stored_number(camera.vertical_field_of_view, error_model.precision_bits)
    return Behaviour({"camera_frame": frame}, (), {"handed_angle": angle}, "the camera")
