"""Exact ties: which comparison of the tracer's source cannot be decided, and what that means in words."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.arithmetic import KERNEL_FILE
from raytruth.reference_tracer.arithmetics.balls import Decisions

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import FrameType

_SPHERE = "touches a sphere exactly, or starts exactly on one that it has not left"
_TRIANGLE = "meets exactly an edge or a corner of a triangle, lies in its plane, or starts on it"

MEANINGS = {
    "sphere_distance": _SPHERE,
    "root_outside": _SPHERE,
    "root_inside": "starts inside a sphere exactly where it is nearest to its centre",
    "distance_to_other_side": "leaves a sphere exactly along its tangent plane",
    "triangle_distance": _TRIANGLE,
    "distance_to_triangle": _TRIANGLE,
    "plane_distance": "runs exactly along a plane, or starts exactly on one that it has not left",
    "nearest_sphere": "meets two spheres at exactly the same distance",
    "nearest_triangle": "meets a triangle at exactly the distance of another surface or of the light",
    "nearest_plane": "meets a plane at exactly the distance of another surface or of the light",
    "is_occluded": "meets a sphere at exactly the distance of the light",
    "is_even_square": "lands exactly on the border of two squares of a checkerboard",
    "fresnel_reflectance": "meets a dielectric exactly along its surface",
    "attenuation": "lands exactly where the light's attenuation reaches its limit of 1",
    "direct_light": "lands on a surface that a light meets exactly edge on",
    "trace_ray": "meets a dielectric at exactly the critical angle",
    "surface_at": "meets a surface exactly edge on",
}
"""What a tie means, by the function of the source that compares; each follows 'the ray' or 'the shadow ray'."""

SHADOW_RAYS = "is_shadowed"
"""The function that every shadow ray is traced for."""

NO_BOUND = "the value has no bound, or one too wide, at the highest precision, although no comparison is a tie"

TOO_MANY = "together these can go more than 64 ways, too many to list"
ONE_HAS_NO_BOUND = "one of the ways that this can go has no bound, so that none is listed"


class UndecidedComparisonError(Exception):
    """A comparison whose outcome the balls leave open."""


class RaisingDecisions(Decisions):
    """Takes no branch that is not proven."""

    def next(self) -> bool:
        """Raises UndecidedComparisonError."""
        raise UndecidedComparisonError


class NotedDecisions(Decisions):
    """Follows scripts, and keeps the sentences on the comparisons that were undecided."""

    def __init__(self) -> None:
        super().__init__()
        self.sentences: set[str] = set()

    def next(self) -> bool:
        """The answer to an undecided comparison."""
        functions = _kernel_functions(inspect.currentframe())
        self.sentences.add(sentence(functions[0], of_shadow_ray=SHADOW_RAYS in functions))
        return super().next()


def sentence(function: str, *, of_shadow_ray: bool) -> str:
    """What it means that a comparison in this function of the source is a tie."""
    ray = "the shadow ray" if of_shadow_ray else "the ray"
    return f"{ray} {MEANINGS.get(function, f'makes a comparison in {function} an exact tie')}"


def explanation(sentences: Iterable[str], obstacle: str = "") -> str:
    """All ties of a pixel in one sentence, and what keeps their outcomes from being listed."""
    ties = sorted(sentences)
    if not ties:
        return NO_BOUND
    return "; ".join([*ties, obstacle] if obstacle else ties)


def _kernel_functions(frame: FrameType | None) -> list[str]:
    """The functions of the tracer's source that are being run, the innermost first."""
    names = []
    while frame is not None:
        if frame.f_code.co_filename.startswith(KERNEL_FILE):
            names.append(frame.f_code.co_name)
        frame = frame.f_back
    return names
