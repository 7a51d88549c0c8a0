"""Faults in which ray belongs to a pixel, and in what is told of its first hit (docs/spec.md, IMG)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, at_the_start


@fault(
    "IMG-1",
    "primary_ray",
    "Which point of pixel (0, 0) has the image coordinates (0, 0)?",
    Edit(
        "along(along(corner, pixel_right, x), pixel_down, y)",
        "along(along(corner, pixel_right, x - 0.5), pixel_down, y - 0.5)",
    ),
)
def half_a_pixel_off() -> None:
    """Rays go through the upper left corners of the pixels instead of their centres."""


# The fractional part of a wild number serves for a random one.
@fault(
    "IMG-1",
    "radiance_at",
    "Render twice with another seed: what changes?",
    at_the_start("""
        wild = tan(12.9898 * x + 78.233 * y) * 43758.5453
        shift = wild - float(int(wild)) - 0.5
        x, y = x + 0.5 * shift, y - 0.5 * shift
        """),
)
def jittered_rays() -> None:
    """Each ray goes through a random point of its pixel, as for anti-aliasing."""


@fault(
    "IMG-4",
    "first_hit_rows",
    "Along which line is the depth of a pixel measured?",
    Edit(
        "depths[row, column] = distance",
        """
        _, _, _, _, forward = frame
        depths[row, column] = distance * dot(direction, forward)
        """,
    ),
    gives="first hits",
)
def depth_along_the_axis() -> None:
    """The depth is measured along the camera's axis, as in a depth buffer, and not along the ray."""


@fault(
    "IMG-2", "render_rows", "How many points has a pixel?", Edit("step * step", "1.0 / float(samples * samples + 1)")
)
def mean_over_one_too_many() -> None:
    """The sum over the points of a pixel is divided by one more than there are."""
