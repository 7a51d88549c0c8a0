"""The outcomes of many pixels in plain balls: compiled where that is worth its while and as tight, else in Arb's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from raytruth.comparisons.feasible_sets.compiled_pixels import CompiledPixels
from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator, UndecidableError
from raytruth.comparisons.feasible_sets.rounded_rays import PlainRays
from raytruth.comparisons.feasible_sets.set_arithmetics import set_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.compiler.names import NotCompilableError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.feasible_pixel import FirstHit
    from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, Pixel
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene

# Arb takes up to a millisecond for each. To compile a kernel takes two seconds, and then it serves all scenes: eight
# images of so few pixels take as long.
FEW_PIXELS = 256


@dataclass(frozen=True)
class Colors:
    """The feasible colours of one pixel."""

    boxes: list[Box]
    merged: bool
    """Whether they were too many to tell apart, or too long to find."""
    spent: bool
    """Whether they were too long to find: the pixel's work was spent before all of its rays were followed."""


class PlainPixels:
    """Finds the outcomes of a scene's pixels under one error model; what they are is told by PixelEvaluator."""

    def __init__(
        self,
        scene: Scene,
        error_model: ErrorModel,
        behaviour: Behaviour,
        bound: RadianceBound | None,
        output_bits: int,
        most_work: int,
    ) -> None:
        self._rays = PlainRays(scene, error_model, behaviour)
        self._in_arb = PixelEvaluator(self._rays, bound, output_bits, most_work)
        # A behaviour besides is that of a faulty tracer, of which there are many, each asked for a few pixels.
        self._compiled: CompiledPixels | None = None
        self._balls = set_arithmetic(error_model.precision_bits) if behaviour is IDEAL else None

    def colors(self, pixels: Sequence[Pixel], *, may_merge: bool) -> list[Colors | None]:
        """The feasible colours of each pixel; None where nothing can be said."""
        compiled = self._compiled_for(len(pixels))
        if compiled is None:
            return [colors_of(self._in_arb, pixel, may_merge=may_merge) for pixel in pixels]
        found: list[Colors | None] = []
        for pixel, color in zip(pixels, compiled.colors(pixels, may_merge=may_merge), strict=True):
            if color.boxes is None:
                found.append(colors_of(self._in_arb, pixel, may_merge=may_merge))
            else:
                found.append(Colors(color.boxes, color.merged, color.spent) if color.boxes else None)
        return found

    def first_hits(self, pixels: Sequence[Pixel]) -> list[list[FirstHit] | None]:
        """What each pixel's ray may meet first; None where nothing can be said."""
        compiled = self._compiled_for(len(pixels))
        if compiled is None:
            return [first_hits_of(self._in_arb, pixel) for pixel in pixels]
        found = zip(pixels, compiled.first_hits(pixels), strict=True)
        return [first_hits_of(self._in_arb, pixel) if hits is None else hits or None for pixel, hits in found]

    def _compiled_for(self, pixels: int) -> CompiledPixels | None:
        """The compiled evaluator, if it is there or is worth its while for so many pixels."""
        if self._compiled is None and self._balls is not None and pixels >= FEW_PIXELS:
            try:
                self._compiled = CompiledPixels(self._in_arb, self._rays, self._balls)
            except NotCompilableError:  # of another package's renderer, perhaps: all of ours are compiled
                self._balls = None
        return self._compiled


class Evaluator(Protocol):
    """Who evaluates pixels one by one, as PixelEvaluator does."""

    spent: bool

    def colors(self, column: int, row: int, *, may_merge: bool = True) -> tuple[list[Box], bool]:
        """The boxes of a pixel's feasible colours, and whether they are merged. Raises UndecidableError."""

    def first_hits(self, column: int, row: int) -> list[FirstHit]:
        """What the pixel's ray may meet first. Raises UndecidableError."""


def colors_of(evaluator: Evaluator, pixel: Pixel, *, may_merge: bool = True) -> Colors | None:
    """The feasible colours of a pixel; None where nothing can be said."""
    try:
        return Colors(*evaluator.colors(*pixel, may_merge=may_merge), evaluator.spent)
    except UndecidableError:
        return None


def first_hits_of(evaluator: Evaluator, pixel: Pixel) -> list[FirstHit] | None:
    """What a pixel's ray may meet first; None where nothing can be said."""
    try:
        return evaluator.first_hits(*pixel)
    except UndecidableError:
        return None
