"""Pixels in linked numbers: on a tape, in compiled code, and in Arb's linked balls where the tape does not serve."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.feasible_pixel import PixelEvaluator
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays
from raytruth.comparisons.feasible_sets.tape_rays import TapeIsFullError, TapeRays
from raytruth.reference_tracer.compiler.names import NotCompilableError

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.feasible_pixel import FirstHit
    from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound
    from raytruth.comparisons.feasible_sets.rounded_rays import Box
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene

# An image of 32 x 24 pixels is to take a minute at most on one process, for each error model: 78 ms a pixel, of which
# plain balls may take 22 (pixel_outcomes.py). What Arb's linked balls count takes 0.5 to 1.2 µs, mostly 0.8:
# 2^16 · 0.8 µs = 52 ms a pixel, shared by those that need it. The library needs 87 % of such a share at most, and 76 %
# but for one pixel.
LINKED_WORK = 2**16
# What the tape counts takes 10 to 50 ns, and of the same pixel it counts 1 to 3 times as much.
TAPE_WORK = 2**20
# To compile a kernel takes 1.5 s, once for all scenes, and to load one that is kept 0.15 s: as long as some ten pixels
# take in Arb's linked balls, of 5 to 40 ms each. Where fewer than a few times as many are asked for, they are Arb's.
WORTH_COMPILING = 32
# The tape computes with 53 bits beside the renderer's roundings, and an operation loses fewer than eight roundings of
# its own: so its radii are at most 8/2^8 larger, and those of Arb, which has 32 bits more, are better above.
MOST_BITS = 53 - 8


class LinkedPixels:
    """Evaluates the pixels of one scene as PixelEvaluator does."""

    def __init__(
        self,
        scene: Scene,
        error_model: ErrorModel,
        behaviour: Behaviour,
        bound: RadianceBound | None,
        output_bits: int,
    ) -> None:
        self._made_of = scene, error_model, behaviour
        self._bound, self._output_bits = bound, output_bits
        self._on_tape = False
        self.share = 1.0
        """How much each pixel may take, in parts of what a pixel may take where all are evaluated."""
        self.spent = False
        """Whether the last pixel would have taken more work than it may."""

    def expect(self, pixels: int) -> None:
        """Say how many pixels will be asked for: the more, the better it is to compile."""
        self._on_tape = self._on_tape or pixels >= WORTH_COMPILING

    def colors(self, column: int, row: int, *, may_merge: bool = True) -> tuple[list[Box], bool]:
        """As PixelEvaluator's."""
        if self._tape is not None:
            try:
                self._tape.most_work = int(TAPE_WORK * self.share)
                return self._tape.colors(column, row, may_merge=may_merge)
            except TapeIsFullError:
                pass
            finally:
                self.spent = self._tape.spent
        self._arb.most_work = int(LINKED_WORK * self.share)
        try:
            return self._arb.colors(column, row, may_merge=may_merge)
        finally:
            self.spent = self._arb.spent

    def first_hits(self, column: int, row: int) -> list[FirstHit]:
        """As PixelEvaluator's."""
        if self._tape is not None:
            try:
                return self._tape.first_hits(column, row)
            except TapeIsFullError:
                pass
        return self._arb.first_hits(column, row)

    @property
    def _tape(self) -> PixelEvaluator | None:
        return self._compiled if self._on_tape else None

    @cached_property
    def _compiled(self) -> PixelEvaluator | None:
        """None where the tape does not serve: for renderers of many bits, and for what the compiler does not know."""
        _, error_model, _ = self._made_of
        if (
            error_model.precision_bits > MOST_BITS or error_model.rasterisation is not None
        ):  # which rounds no camera rays
            return None
        try:
            return PixelEvaluator(TapeRays(*self._made_of), self._bound, self._output_bits, TAPE_WORK)
        except (NotCompilableError, TapeIsFullError):
            return None

    @cached_property
    def _arb(self) -> PixelEvaluator:
        return PixelEvaluator(LinkedRays(*self._made_of), self._bound, self._output_bits, LINKED_WORK)
