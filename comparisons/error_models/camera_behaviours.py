"""What a renderer's camera computes otherwise than the tracer's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.error_models.handed_cameras import handed_camera
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, edited
from raytruth.scenes.camera import PerspectiveCamera

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.scenes.scene import Scene


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
    frame = edited("camera_frame", from_angle, to_height, *error_model.camera_rays.edits(), helpers=("handed_angle",))
    angle: Any = stored_number(camera.vertical_field_of_view, error_model.precision_bits)
    return Behaviour({"camera_frame": frame}, (), {"handed_angle": angle}, "the camera")
