"""All renderers that raytruth knows, and those that other packages bring."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.renderers.closed_form.adapter import ClosedFormRenderer
from raytruth.comparisons.renderers.cycles.adapter import Cycles
from raytruth.comparisons.renderers.embree.adapter import embree, embree_robust
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_llvm, mitsuba_scalar
from raytruth.comparisons.renderers.own_tracer import ReferenceTracer
from raytruth.comparisons.renderers.povray import PovRay
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.third_party.entry_points import third_party
from raytruth.comparisons.renderers.vtk.adapter import Vtk
from raytruth.scenes.wording import quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterable

    from raytruth.comparisons.renderers.protocol import Renderer


# Those whose code is that of another are one opinion, under the name of their project. The tracer itself is none.
_FAMILIES = {"mitsuba-llvm": "mitsuba", "embree-robust": "embree", "raytruth": None}


def family_of(renderer: Renderer) -> str | None:
    """The project whose opinion a renderer is, which counts once.

    None for the tracer that the truth comes from, and for a user's program that is no reference: it is tested.
    """
    if isinstance(renderer, ProgramRenderer):
        declared = renderer.declaration
        return (declared.family or renderer.name) if declared.reference else None
    return _FAMILIES.get(renderer.name, renderer.name)


class UnknownRendererError(Exception):
    """A name that no renderer has; the message is one sentence."""


def all_renderers() -> dict[str, Renderer]:
    """Each renderer by its name, available here or not: ours, and those that other packages bring."""
    own = _own_renderers()
    return own | third_party(frozenset(own)).renderers


def unusable_adapters() -> tuple[str, ...]:
    """A sentence for each renderer of other packages that is left out."""
    return third_party(frozenset(_own_renderers())).problems


def _own_renderers() -> dict[str, Renderer]:
    renderers: tuple[Renderer, ...] = (
        mitsuba_scalar(),
        mitsuba_llvm(),
        PovRay(),
        Cycles(),
        embree(),
        embree_robust(),
        Vtk(),
        ClosedFormRenderer(),
        ReferenceTracer(),
    )
    return {renderer.name: renderer for renderer in renderers}


def select_renderers(names: Iterable[str]) -> dict[str, Renderer]:
    """The renderers of these names, each once and in this order; all of them for no names.

    Raises UnknownRendererError for a name that none has.
    """
    known = all_renderers()
    selected: dict[str, Renderer] = {}
    for name in names:
        if name not in known:
            raise UnknownRendererError(f"There is no renderer {quoted(name)}: {suggestion(name, known)}")
        selected[name] = known[name]
    return selected or known
