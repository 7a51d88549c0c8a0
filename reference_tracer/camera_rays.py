"""Through which point of each pixel its ray goes: the centre, as the specification has it, or another by convention."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, edited

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.behaviour import Function


@dataclass(frozen=True)
class CameraRays:
    """The ray of pixel (i, j) goes through the point (i + x, j + y) of the image, in pixels from its top left corner.

    Edge to edge, that point is stretched so that 0 stays one edge of the image and the last row or column, W - 1, is at
    the other, W: it is multiplied with W/(W - 1) and H/(H - 1). x and y are multiples of 1/2, so that floats hold them.
    """

    x: float = 0.5
    y: float = 0.5
    edge_to_edge: bool = False

    def behaviour(self) -> Behaviour:
        """What that changes in the tracer's source, whose callers ask for the ray through (i + 1/2, j + 1/2)."""
        if self == CENTRES:
            return IDEAL
        frame: Function = edited("camera_frame", *self.edits())
        return Behaviour({"camera_frame": frame}, name="camera rays")

    def edits(self) -> tuple[Edit, ...]:
        """The edits of `camera_frame` that it takes."""
        if self == CENTRES:
            return ()
        right, down = self._pitch("width"), self._pitch("height")
        return (
            Edit("-0.5 * width * pixel", f"{self.x - 0.5} * {right} - 0.5 * width * pixel"),
            Edit("-0.5 * height * pixel", f"{self.y - 0.5} * {down} - 0.5 * height * pixel"),
            Edit("scale(right, pixel)", f"scale(right, {right})"),
            Edit("scale(down, pixel)", f"scale(down, {down})"),
        )

    def in_words(self) -> str:
        """Which points of pixels the rays go through, as a clause for people."""
        if self == CENTRES:
            return "their centres"
        stretched = ", stretched so that the last is on the image's edge" if self.edge_to_edge else ""
        return f"{self.x:g} right and {self.y:g} down of their top left corners{stretched}"

    def _pitch(self, side: str) -> str:
        return f"(pixel * {side} / ({side} - 1.0))" if self.edge_to_edge else "pixel"


CENTRES = CameraRays()
