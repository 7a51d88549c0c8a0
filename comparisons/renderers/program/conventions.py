"""Conventions of a program's pictures, which are no mistakes: undone before it is judged, where nothing is lost.

What moves pixels is undone on the picture. What the program is told is said in its own terms: the side that an angle
belongs to, the counting of depth. Where its rays go through other points of the pixels, the truth is found for these.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

from pydantic import Field

from raytruth.comparisons.error_models.handed_cameras import FieldOfView, handed_camera
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.renderers.program.declared_part import Part
from raytruth.reference_tracer.camera_rays import CameraRays

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

    Number = TypeVar("Number", bound=np.generic)

Truth = Annotated[bool, Field(strict=True)]

# A program counts the camera's ray, the light's or both, or the first bounce from 0.
_MOST_DEPTH = 10
# Beyond float32's largest number nothing could be written.
_LARGEST_SCALE = 1e30

CORNERS: dict[str, tuple[float, float]] = {
    "centre": (0.5, 0.5),
    "top left": (0.0, 0.0),
    "top right": (1.0, 0.0),
    "bottom left": (0.0, 1.0),
    "bottom right": (1.0, 1.0),
}
"""Right and down of the top left corner of a pixel, in pixels, as they lie in the picture's file."""


class Conventions(Part):
    """How the program's picture lies, and what it takes the scene's numbers for; undone before it is judged."""

    flip_x: Truth = Field(False, description="The first column of the file is the rightmost.")
    flip_y: Truth = Field(False, description="The first row of the file is the lowest, other than its format says.")
    handedness: Literal["right", "left"] = Field(
        "right",
        description="'left' if the camera's right is up × forward where it should be forward × up, so that the picture "
        "is mirrored: undone as flip_x is.",
    )
    pixel: Literal["centre", "top left", "top right", "bottom left", "bottom right"] = Field(
        "centre",
        description="Through which point of each pixel its ray goes, as the pixels lie in the file. The truth is found "
        "for these rays.",
    )
    pitch: Literal["size", "size less one"] = Field(
        "size",
        description="'size less one' if the picture's width is divided by W - 1 and its height by H - 1, so that with "
        "'top left' the rays of the first and the last column go through both edges.",
    )
    field_of_view: FieldOfView = Field(
        "vertical",
        description="The side of the picture that the scene's angle is taken for; the program is told the angle that "
        "belongs to it.",
    )
    depth: int = Field(
        0,
        strict=True,
        ge=-_MOST_DEPTH,
        le=_MOST_DEPTH,
        description="Added to the scene's max_depth, and so to {depth}: 1 for a program that counts the camera's ray, "
        "too. Scenes of which nothing is left are incomparable.",
    )
    scale: float = Field(
        1.0,
        strict=True,
        gt=0,
        le=_LARGEST_SCALE,
        description="How many times the radiance is written: 255.0 for floats from 0 to 255, or an exposure.",
    )
    clamped_samples: Truth = Field(
        False,
        description="Each sample is clamped to 1 before the mean is taken. With one sample that is the same as "
        "clipped; with more, scenes that may be brighter are incomparable.",
    )

    @property
    def mirrored(self) -> bool:
        """Whether columns are to be reversed: two mirrors are none."""
        return self.flip_x != (self.handedness == "left")

    def undone(self, pixels: NDArray[Number]) -> NDArray[Number]:
        """The same pixels from the scene's top left, shape (height, width, …)."""
        return pixels[:: -1 if self.flip_y else 1, :: -1 if self.mirrored else 1]

    def camera_rays(self) -> CameraRays:
        """The rays of the pixels as they lie in the scene's image, after flips are undone."""
        edge_to_edge = self.pitch != "size"
        x, y = CORNERS[self.pixel]
        x, y = _unflipped(x, self.mirrored, edge_to_edge), _unflipped(y, self.flip_y, edge_to_edge)
        return CameraRays(x, y, edge_to_edge)

    def handed(self, scene: Scene) -> Scene:
        """The scene as the program is told it, of which `refuses` has nothing to say."""
        camera = handed_camera(self.field_of_view, scene.camera)
        return scene.model_copy(update={"camera": camera, "max_depth": scene.max_depth + self.depth})

    def refuses(self, scene: Scene, samples: int) -> str | None:
        """Why the conventions cannot be undone in this scene, for so many samples; None if they can."""
        if scene.max_depth + self.depth < 0:
            return f"its depth of {scene.max_depth} would be {scene.max_depth + self.depth} by the program's counting"
        if self.pitch != "size" and min(scene.camera.width, scene.camera.height) == 1:
            return "a picture with one row or column has no size less one"
        if self.clamped_samples and samples > 0:
            bound = radiance_bound(scene)
            if bound is None or bound.at_camera > 1.0:
                return "its samples are clamped before their mean is taken, and here some may be above 1"
        return None


def _unflipped(within: float, is_flipped: bool, edge_to_edge: bool) -> float:
    """Where in the scene's pixel the ray goes, if that of row j of H in the file goes through (j + within)·s.

    s is 1, or H/(H - 1) edge to edge.
    Flipped, the scene's row i is that of j = H - 1 - i, and the ray goes through H - (j + within)·s. That is
    i + 1 - within for s = 1, and (i - within)·s edge to edge.
    """
    if not is_flipped:
        return within
    return -within if edge_to_edge else 1.0 - within
