"""Which pixels are evaluated in compiled code, and that the others are Arb's."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets import plain_pixels
from raytruth.comparisons.feasible_sets.compiled_pixels import CompiledPixels, FoundColors
from raytruth.comparisons.feasible_sets.pixel_outcomes import FLOAT32_BITS, PLAIN_WORK
from raytruth.comparisons.feasible_sets.plain_pixels import FEW_PIXELS, PlainPixels
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.compiler.names import NotCompilableError
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from typing import Any

pytestmark = pytest.mark.clause("VER-2")

SCENE = library_scene("single-sphere", 4, 3)
SOME = [(column, row) for row in range(3) for column in range(4)]
MANY = SOME * (FEW_PIXELS // len(SOME) + 1)


def plain(bits: int = 24, behaviour: Behaviour = IDEAL) -> PlainPixels:
    return PlainPixels(SCENE, ErrorModel("", bits), behaviour, None, FLOAT32_BITS, PLAIN_WORK)


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many pixels the compiled evaluator is asked for, call by call."""
    calls: list[int] = []
    colors, hits = CompiledPixels.colors, CompiledPixels.first_hits

    def counting_colors(self: CompiledPixels, pixels: Any, *, may_merge: bool) -> Any:
        calls.append(len(pixels))
        return colors(self, pixels, may_merge=may_merge)

    def counting_hits(self: CompiledPixels, pixels: Any) -> Any:
        calls.append(len(pixels))
        return hits(self, pixels)

    monkeypatch.setattr(CompiledPixels, "colors", counting_colors)
    monkeypatch.setattr(CompiledPixels, "first_hits", counting_hits)
    return calls


def test_many_pixels_are_compiled_and_then_few_ones_too(monkeypatch: pytest.MonkeyPatch) -> None:
    calls, pixels = counted(monkeypatch), plain()
    few = [color is not None and len(color.boxes) for color in pixels.colors(SOME, may_merge=False)]
    pixels.first_hits(SOME)
    assert calls == []
    assert pixels.colors(MANY, may_merge=False)
    assert [color is not None and len(color.boxes) for color in pixels.colors(SOME, may_merge=False)] == few
    assert [len(hits or []) for hits in pixels.first_hits(SOME)] == [
        len(hits or []) for hits in plain().first_hits(SOME)
    ]
    assert calls == [len(MANY), len(SOME), len(SOME)]


@pytest.mark.parametrize("pixels", [plain(60), plain(24, Behaviour(name="a fault"))], ids=["many bits", "a fault"])
def test_what_compiled_balls_do_not_serve_is_arbs(pixels: PlainPixels, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch)
    assert len(pixels.colors(MANY, may_merge=False)) == len(pixels.first_hits(MANY)) == len(MANY)
    assert calls == []


def test_a_behaviour_that_is_not_compiled_is_arbs(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise NotCompilableError

    monkeypatch.setattr(plain_pixels, "CompiledPixels", refuse)
    assert all(plain().colors(MANY, may_merge=False))


def test_a_pixel_that_has_no_room_is_arbs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        CompiledPixels, "colors", lambda _, pixels, **__: [FoundColors(None, False, False)] * len(pixels)
    )
    monkeypatch.setattr(CompiledPixels, "first_hits", lambda _, pixels: [None] * len(pixels))
    pixels, in_arb = plain(), plain(60)
    found = pixels.colors(MANY, may_merge=False)
    assert [len(color.boxes) if color else 0 for color in found] == [
        len(color.boxes) if color else 0 for color in in_arb.colors(MANY, may_merge=False)
    ]
    assert all(pixels.first_hits(MANY))
