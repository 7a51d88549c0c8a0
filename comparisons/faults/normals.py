"""Faults in the orientation of normals (docs/spec.md, ILL-1 and REFR-1)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit


@fault(
    "ILL-1",
    "surface_at",
    "What does the inside of an open surface look like?",
    Edit("outward if entering else negate(outward)", "outward"),
)
def normal_not_turned_to_the_viewer() -> None:
    """The normal stays as the shape has it, so n·l is taken with a normal that points away from the viewer."""


@fault(
    "ILL-1",
    "surface_at",
    "What decides on which side of a surface the viewer is?",
    Edit("outward if entering else negate(outward)", "negate(outward) if outward[1] < 0.0 else outward"),
)
def normal_turned_upward() -> None:
    """Normals are turned upward instead of to the viewer."""


@fault(
    "REFR-1",
    "surface_at",
    "How can a ray tell that it is inside of the glass?",
    Edit("point, normal, entering", "point, normal, True"),
)
def every_ray_enters() -> None:
    """Rays that leave the glass are taken to enter it once more."""
