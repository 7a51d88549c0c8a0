"""The outcomes of many pixels: quickly in plain balls, and in linked ones where these do not do."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.feasible_pixel import widest
from raytruth.comparisons.feasible_sets.linked_pixels import LinkedPixels
from raytruth.comparisons.feasible_sets.plain_pixels import Colors, PlainPixels, colors_of, first_hits_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.feasible_pixel import FirstHit
    from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound
    from raytruth.comparisons.feasible_sets.rounded_rays import Pixel
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene

# Of the image's largest value, a quarter of a step of an 8-bit picture: wider, and a test of the pixel would be weak.
WIDE = 2.0**-10
FLOAT32_BITS = 24
# An image of 32 x 24 pixels is to take a minute at most on one process, for each error model: 78 ms a pixel. What plain
# balls count takes 2 to 4 µs, and a pixel is evaluated in them twice at most: 2 · 2^12 · 2.7 µs = 22 ms. The library
# needs 3,600 at most.
PLAIN_WORK = 2**12


class PixelOutcomes:
    """Finds the outcomes of a scene's pixels under one error model; `share` is their part of an image's work."""

    def __init__(
        self,
        scene: Scene,
        error_model: ErrorModel,
        behaviour: Behaviour,
        bound: RadianceBound | None,
        share: float = 1.0,
    ) -> None:
        self._model, self._model_of_light = error_model, error_model.of_light()
        self._linked_share = scene.camera.width * scene.camera.height * share
        # Made only where they are needed; often the error model is that of light, too.
        self._plain = cache(lambda model: PlainPixels(scene, model, behaviour, bound, FLOAT32_BITS, PLAIN_WORK))
        self._linked = cache(lambda model: LinkedPixels(scene, model, behaviour, bound, FLOAT32_BITS))

    def colors_and_hits(
        self, pixels: Sequence[Pixel], *, with_colors: bool = True, with_hits: bool = True, brightest: float = 0.0
    ) -> tuple[list[Colors | None], list[list[FirstHit] | None]]:
        """The colours and the first hits of each pixel; None where nothing can be said, and for what is not asked for.

        All pixels are evaluated in plain balls; in linked ones those of which plain ones say nothing, or cannot tell
        all outcomes apart, and those whose boxes are wide beside the image's brightest value, which is at least
        `brightest`. Where the surface that a ray leaves is tested by a formula, also those with several outcomes.
        """
        colors: list[Colors | None] = [None] * len(pixels)
        hits: list[list[FirstHit] | None] = [None] * len(pixels)
        if with_colors:
            colors = self._plain(self._model_of_light).colors(pixels, may_merge=False)
            self._sharpen(pixels, colors, brightest)
        if with_hits:
            hits = self._plain(self._model).first_hits(pixels)
            for place in [place for place, hit in enumerate(hits) if hit is None]:
                hits[place] = first_hits_of(self._linked(self._model), pixels[place])
        return colors, hits

    def _sharpen(self, pixels: Sequence[Pixel], colors: list[Colors | None], brightest: float) -> None:
        model = self._model_of_light
        unclear = [place for place, color in enumerate(colors) if color is None]
        wide = _loose(colors, brightest, model)
        if not unclear and not wide:
            return
        linked = self._linked(model)
        linked.expect(len([*unclear, *wide]))
        linked.share = self._linked_share / len([*unclear, *wide])
        for place in unclear:
            pixel = pixels[place]
            colors[place] = colors_of(linked, pixel)
            if colors[place] is None and not linked.spent:
                (colors[place],) = self._plain(model).colors([pixel], may_merge=True)
        for place in sorted(
            set(_loose(colors, brightest, model)) - set(unclear)
        ):  # fewer, now that the brightest is known
            colors[place] = _sharper(colors_of(linked, pixels[place]), colors[place])


def _loose(colors: Sequence[Colors | None], brightest: float, model: ErrorModel) -> list[int]:
    """Where linked balls may leave less open: where boxes are wide, or a ray may or may not meet what it has left.

    Plain balls do not know that a point lies on its sphere: only how far off each coordinate may be. So they let a ray
    meet its own start up to a least distance that is ten times as long.
    """
    wide = set(_wide(colors, brightest))
    if model.needs_policies and not all(offset.excludes_surface for offset in model.offsets()):
        wide |= {place for place, color in enumerate(colors) if color and len(color.boxes) > 1}
    return sorted(wide)


def _wide(colors: Sequence[Colors | None], brightest: float) -> list[int]:
    """Where boxes are wide."""
    widest_radius = WIDE * max(brightest, brightest_of(colors))
    return [place for place, color in enumerate(colors) if color and widest(color.boxes) > widest_radius]


def _sharper(linked: Colors | None, plain: Colors | None) -> Colors | None:
    """The outcomes in linked balls, unless both ways left rays open, and they more than plain ones."""
    if linked and plain and linked.spent and plain.spent and widest(plain.boxes) < widest(linked.boxes):
        return plain
    return linked or plain


def brightest_of(colors: Sequence[Colors | None]) -> float:
    """The largest value of a channel among the known colours; 0 if none is known."""
    known = [box for color in colors if color for box in color.boxes]
    return max((float(channel.mid()) for box in known for channel in box), default=0.0)
