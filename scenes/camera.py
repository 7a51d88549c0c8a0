"""Cameras: where the eye is, and how it projects."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from raytruth.scenes.values import Direction, Part, Positive, Vector

# A side longer than this is a typing error rather than a picture: 8192² pixels of float32 RGB are already 800 MB.
LARGEST_SIDE = 8192

PixelCount = Annotated[int, Field(strict=True, ge=1, le=LARGEST_SIDE)]


class CameraBase(Part):
    """What both kinds of camera state. Axes are right-handed; `up` need not be perpendicular to the view."""

    position: Vector
    look_at: Vector
    up: Direction = (0.0, 1.0, 0.0)
    width: PixelCount
    height: PixelCount
    inside: str | None = None
    """Name of the dielectric material that the camera is inside of; none: in empty space."""


class PerspectiveCamera(CameraBase):
    """Rays leave one point; `vertical_field_of_view` in degrees, between 0 and 180."""

    projection: Literal["perspective"]
    vertical_field_of_view: Annotated[float, Field(strict=True, gt=0, lt=180)]


class OrthographicCamera(CameraBase):
    """Parallel rays; `view_height` is the height of the visible rectangle in scene units."""

    projection: Literal["orthographic"]
    view_height: Positive


Camera = Annotated[PerspectiveCamera | OrthographicCamera, Field(discriminator="projection")]
