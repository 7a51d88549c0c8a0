"""Where a program's ray tree first leaves all those that a right tracer may have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.grading.traces.ways import Ways
from raytruth.comparisons.records.ray_tree_results import Comparison, Divergence
from raytruth.reference_tracer.arithmetics.balls import TooManyOutcomesError
from raytruth.reference_tracer.source.traversal import NOTHING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.rounded_rays import Ray
    from raytruth.comparisons.grading.traces.ray_lines import RayLine
    from raytruth.comparisons.grading.traces.ways import Way
    from raytruth.comparisons.records.ray_tree_results import What
    from raytruth.scenes.scene import Scene

# What weighs less than a rounding of 1 in float32 need not be traced.
NEGLIGIBLE = 2.0**-24


def compared(
    scene: Scene, models: Sequence[ErrorModel], column: int, row: int, rays: Mapping[str, RayLine]
) -> Comparison:
    """The tree of a pixel against those of the error models: of the one with which it agrees longest."""
    found = [_Tree(Ways(scene, model), rays).compared(column, row) for model in models]
    return max(found, key=lambda comparison: (comparison.divergence is None, comparison.agreed))


class _Tree:
    """One comparison by one error model."""

    def __init__(self, ways: Ways, rays: Mapping[str, RayLine]) -> None:
        self.ways = ways
        self.rays = rays
        self.agreed = 0
        self.open_paths: list[str] = []

    def compared(self, column: int, row: int) -> Comparison:
        divergence = self._follow("", self.ways.camera_ray(column, row))
        open_paths = tuple(dict.fromkeys(self.open_paths))
        return Comparison(agreed=self.agreed, divergence=divergence, open_paths=open_paths)

    def _follow(self, path: str, ray: Ray) -> Divergence | None:
        """Rays first, in the order in which they are sent on; then what each brings back, the last first."""
        line = self.rays[path]
        told = _mismatch(path, "origin", line.origin, ray[0]) or _mismatch(path, "direction", line.direction, ray[1])
        if told is not None:
            return told
        try:
            ways = self.ways.of(self.ways.restarted(ray, line.origin, line.direction))
        except TooManyOutcomesError:
            self.open_paths.append(path)
            return None
        mismatches = [(list(_mismatches(path, line, way)), way) for way in ways]
        fitting = [way for told, way in mismatches if not told]
        if not fitting:
            return max((told[0] for told, _ in mismatches), key=lambda first: _ORDER.index(first.what))
        self.agreed += 1
        found = [self._children(path, way) for way in fitting]
        return None if None in found else found[0]

    def _children(self, path: str, way: Way) -> Divergence | None:
        expected = {path + letter for letter in way.children}
        extra = sorted(
            it for it in self.rays if len(it) == len(path) + 1 and it.startswith(path) and it not in expected
        )
        if extra:
            return Divergence(path=extra[0], what="extra")
        for letter, ray in way.children.items():
            if path + letter in self.rays:
                told = self._follow(path + letter, ray)
                if told is not None:
                    return told
            elif not all(weight < NEGLIGIBLE for weight in ray[2]):
                return Divergence(path=path + letter, what="missing")
        return self._color(path, way)

    def _color(self, path: str, way: Way) -> Divergence | None:
        """What the ray brings back, by what the program says that its own rays bring."""
        colors = {letter: self.rays[path + letter].color for letter in way.children if path + letter in self.rays}
        known = {letter: color for letter, color in colors.items() if color is not None}
        if known.keys() != way.children.keys():
            return None
        return _mismatch(path, "color", self.rays[path].color, self.ways.brought(way, known))


_ORDER: tuple[What, ...] = ("primitive", "distance", "normal", "local")


def _mismatches(path: str, line: RayLine, way: Way) -> Iterator[Divergence]:
    """What a way does not explain, in order."""
    stated = line.model_fields_set
    hit = NOTHING if line.primitive is None else line.primitive
    if "primitive" in stated and hit != way.primitive:
        yours, right = (() if it == NOTHING else (float(it),) for it in (hit, way.primitive))
        yield Divergence(path=path, what="primitive", found=yours, low=right, high=right)
    if "distance" in stated:
        if (line.distance is None) != (way.distance is None):
            found = () if line.distance is None else (line.distance,)
            yield _divergence(path, "distance", found, (way.distance,))
        elif line.distance is not None:
            yield from _some(_mismatch(path, "distance", (line.distance,), (way.distance,)))
    if way.normal is not None:
        yield from _some(_mismatch(path, "normal", line.normal, way.normal))
    yield from _some(_mismatch(path, "local", line.local, way.local))


def _some(told: Divergence | None) -> Iterator[Divergence]:
    if told is not None:
        yield told


def _mismatch(path: str, what: What, found: tuple[float, ...] | None, balls: tuple[Any, ...]) -> Divergence | None:
    """None where each number lies in its ball; what nothing is known of, or was not printed, is no mismatch."""
    if found is None or all(_lies_in(value, ball) for value, ball in zip(found, balls, strict=True)):
        return None
    return _divergence(path, what, tuple(found), balls)


def _lies_in(value: float, ball: Any) -> bool:
    return not ball.is_finite() or bool(ball.lower() <= value <= ball.upper())


def _divergence(path: str, what: What, found: tuple[float, ...], balls: tuple[Any, ...]) -> Divergence:
    """What was found beside the ends of balls; None stands for nothing to be hit."""
    known = [ball for ball in balls if ball is not None]
    low, high = (
        tuple(float(end) for end in ends) for ends in ([it.lower() for it in known], [it.upper() for it in known])
    )
    return Divergence(path=path, what=what, found=found, low=low, high=high)
