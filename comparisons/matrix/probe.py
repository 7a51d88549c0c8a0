"""The tightest declaration under which a program is right, so that nobody has to guess it.

Fewer bits leave more open, so what holds with some holds with fewer: the most bits are found by halving. A ray offset
leaves no more open than none, but something else: several are tried, small ones first.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.comparisons.judgement.kept_expectation import kept_expectation
from raytruth.comparisons.judgement.verdict import judge_exact
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.records import renderings
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers.program.declaration import Arithmetic, Rays
from raytruth.comparisons.renderers.program.declared_model import (
    MOST_BITS_OF_ANGLES,
    PRECISIONS,
    error_model_of_declaration,
)
from raytruth.reference_tracer.rendering import primary_rays

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from raytruth.comparisons.judgement.verdict import ImageVerdict
    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.records.results import Verdict, WorstPixel
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.comparisons.renderers.program.declaration import Declaration
    from raytruth.scenes.scene import Scene

# Powers of ten, as people write them: from a float32's rounding of 1 to what nobody would overlook in a picture.
TRIED_OFFSETS = tuple(10.0**-digits for digits in range(7, 1, -1))


@dataclass(frozen=True, eq=False)
class Picture:
    """What a program gives for a scene."""

    scene: Scene
    image: Image


@dataclass(frozen=True)
class Obstacle:
    """What fails with one bit more: the worst pixel of a picture."""

    scene: str
    pixel: WorstPixel


@dataclass(frozen=True)
class Found:
    """The most bits with which every picture holds, for rays like these; None where no number of bits will do."""

    rays: Rays
    bits: int | None
    obstacle: Obstacle | None
    """None where the program's numbers have no more bits."""


def pictures_of(program: ProgramRenderer, scenes: Iterable[Scene]) -> list[Picture]:
    """One of each scene that the program can render. Raises RendererError, with the scene's name, where it does not."""
    (integrator,) = program.integrators
    pictures = []
    for scene in scenes:
        depth = depth_or_reason(scene, program, integrator)
        if isinstance(depth, int):
            pictures.append(Picture(scene, _rendered(program, scene, depth)))
    return pictures


def tightest_declaration(declaration: Declaration, pictures: Sequence[Picture]) -> Found:
    """The declaration with the most bits under which no picture fails, and of these the one with the smallest offset.

    No fewer than half of the numbers' own bits are tried: so many digits cancel at most in what people write, as in the
    difference of two squares (Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 1.8). Where these
    do not hold either, the result has no bits, and what is in the way of rays without offset.
    """
    fails = most_bits(declaration)
    search = _Search(declaration, list(pictures))
    rays = search.rays_that_hold(fails)
    if rays is not None:
        return Found(rays, fails, None)
    holds = fails // 2
    rays = search.rays_that_hold(holds)
    if rays is None:
        return Found(Rays(), None, search.obstacle(Rays(), holds))
    while fails - holds > 1:
        middle = (holds + fails) // 2
        found = search.rays_that_hold(middle)
        if found is None:
            fails = middle
        else:
            holds, rays = middle, found
    return Found(rays, holds, search.obstacle(rays, fails))


class _Search:
    """Which rays hold with how many bits."""

    def __init__(self, declaration: Declaration, pictures: list[Picture]) -> None:
        self.declaration, self.pictures = declaration, pictures

    def rays_that_hold(self, bits: int) -> Rays | None:
        """The first of those to try with which no picture fails."""
        tried = _rays_to_try(self.declaration.rays)
        return next((rays for rays in tried if self.obstacle(rays, bits) is None), None)

    def obstacle(self, rays: Rays, bits: int) -> Obstacle | None:
        """What fails with these; the next search begins with that picture, since it is likely to fail again."""
        declared = _stated(self.declaration, rays, bits)
        for place, picture in enumerate(self.pictures):
            judgement = _judged(declared, picture).judgement
            if judgement.failing:
                assert judgement.worst is not None, "an image has a pixel"
                self.pictures.insert(0, self.pictures.pop(place))
                return Obstacle(picture.scene.name, judgement.worst)
        return None


def verdicts(declaration: Declaration, found: Found, pictures: Sequence[Picture]) -> dict[str, Verdict]:
    """What each scene's picture gets under the declaration that was found."""
    assert found.bits is not None, "without bits there is no declaration"
    stated = _stated(declaration, found.rays, found.bits)
    return {picture.scene.name: _judged(stated, picture).verdict for picture in pictures}


def most_bits(declaration: Declaration) -> int:
    """Of the program's numbers, and of what can be declared of them."""
    bits = PRECISIONS[declaration.arithmetic.precision or "float64"]
    has_usual_camera = declaration.conventions.field_of_view == "vertical"
    return bits if has_usual_camera else min(bits, MOST_BITS_OF_ANGLES)


def _rendered(program: ProgramRenderer, scene: Scene, depth: int) -> Image:
    (integrator,) = program.integrators
    with TemporaryDirectory(prefix="raytruth-") as folder:
        try:
            rendering = program.render(
                scene, integrator.name, depth, renderings.Rays(*primary_rays(scene)), Path(folder)
            )
        except RendererError as error:
            raise RendererError(f"{scene.name}: {error}") from error
    assert rendering.image is not None, "a program gives images"
    return rendering.image


def _rays_to_try(declared: Rays) -> Iterator[Rays]:
    """None that start beside the surface; then those that are declared or, where nothing is, the usual ones."""
    yield Rays()
    if declared != Rays():
        yield declared
        return
    for offset in TRIED_OFFSETS:
        yield Rays(least_distance=offset)
        yield Rays(offset=offset)


def _stated(declaration: Declaration, rays: Rays, bits: int) -> Declaration:
    arithmetic = Arithmetic(bits=bits, smallest=declaration.arithmetic.smallest)
    return declaration.model_copy(update={"arithmetic": arithmetic, "rays": rays})


def _judged(declaration: Declaration, picture: Picture) -> ImageVerdict:
    error_model = error_model_of_declaration(declaration).in_scene(picture.scene)
    return judge_exact(picture.image, kept_expectation(picture.scene, error_model))
