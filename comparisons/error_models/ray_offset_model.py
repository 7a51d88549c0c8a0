"""Where rays start that leave a surface, and which hits they leave out: as an error model declares it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class RayOffset:
    """Where secondary and shadow rays start that leave a surface at p: at p + v·(absolute + relative·max|p|).

    v is the unit normal on the side that the ray goes to, or the ray's own unit direction. max|p| is the largest
    absolute coordinate. Raises ValueError for a combination that no renderer can have.
    """

    absolute: float = 0.0
    """A length in units of the scene."""
    relative: float = 0.0
    along: Literal["normal", "direction"] = "normal"
    minimum_distance: float = 0.0
    """Hits nearer than this to where a ray starts are ignored, a camera's ray included; in units of the scene."""
    excludes_surface: bool = True
    """Whether a ray cannot meet again the point that it leaves: by the identity of the primitive, or since the offset
    is far above all rounding. If not, the primitive is tested as all others are: of a sphere both roots."""
    is_bound: bool = False
    """Whether only some rays are moved, those that would miss the triangle that they leave, and by no more than that.
    So each coordinate of a ray's start may be off by anything up to that, to either side (bounded_offsets.py)."""
    relative_minimum_distance: float = 0.0
    """Added to the least distance: so many times the largest absolute coordinate of where the ray starts."""
    scale: Literal["point", "scene"] = "point"
    """Of what the largest absolute coordinate is taken that `relative` and `relative_minimum_distance` are multiplied
    with: of the point that a ray leaves, or of all points of the scene's shapes, spheres as a whole."""
    error_bound: float = 0.0
    """In roundoffs: a start is moved along the normal by anything up to so many of the numbers that its point is
    computed from (start_bounds.py), as by who derives the offset from a bound of the point's error."""
    in_units: bool = False
    """Whether coordinates are moved by units in the last place of float32, as Wächter and Binder do (2019)."""

    def __post_init__(self) -> None:
        numbers = (self.absolute, self.relative, self.minimum_distance)
        if min(*numbers, self.relative_minimum_distance, self.error_bound) < 0.0:
            raise ValueError("a ray offset is not negative")
        others = self.needs_policies or self.error_bound > 0.0
        if self.is_bound and others:
            raise ValueError("a bound on an offset is declared without any of the other policies")
        if self.in_units and (self.absolute, self.relative, self.error_bound, self.along) != (0.0, 0.0, 0.0, "normal"):
            raise ValueError("coordinates that are moved by units in the last place are moved by nothing else")
        if self.error_bound > 0.0 and self.along == "direction":
            raise ValueError("a bound of a point's error moves starts along the normal")
        if self.is_bound and not (self.moves_rays and self.excludes_surface):
            raise ValueError(
                "a bound on an offset is above 0, and the surface is excluded, on whichever side a ray starts"
            )

    @property
    def moves_rays(self) -> bool:
        """Whether rays start beside the surface."""
        return max(self.absolute, self.relative, self.error_bound) > 0.0 or self.in_units

    @property
    def ignores_near_hits(self) -> bool:
        """Whether there is a least distance, the one shortcut that camera rays take."""
        return self.minimum_distance > 0.0 or self.relative_minimum_distance > 0.0

    @property
    def needs_policies(self) -> bool:
        """Whether ray_policies.py tells it, and not ray_offsets.py."""
        return (
            self.relative_minimum_distance > 0.0
            or self.scale == "scene"
            or self.error_bound > 0.0
            or self.in_units
            or (self.excludes_surface and (self.minimum_distance > 0.0 or self.along == "direction"))
        )

    def in_words(self) -> str:
        """The offset as a clause for people, as in `raytruth renderers`."""
        start = f"{self._length()} along the {self._vector()}" if self.moves_rays else "on the surface"
        start = f"up to {start}, to either side" if self.is_bound else start
        least = _length_in_words(self.minimum_distance, self.relative_minimum_distance, self._largest("o"))
        nearest = f", hits nearer than {least} are ignored" if self.ignores_near_hits else ""
        left = "cannot be hit again there" if self.excludes_surface else "is tested as all others are"
        return f"{start}{nearest}; the surface {left}"

    def _length(self) -> str:
        if self.in_units:
            return "256 units of float32 in the last place, or 2^-16 near 0, for each coordinate"
        length = _length_in_words(self.absolute, self.relative, self._largest("p"))
        bound = f"up to {self.error_bound:.3g} roundoffs of the point's terms" if self.error_bound > 0.0 else ""
        return " and ".join(filter(None, [length, bound]))

    def _largest(self, point: str) -> str:
        return f"max|{point}|" if self.scale == "point" else "the scene's largest coordinate"

    def _vector(self) -> str:
        return "normal" if self.along == "normal" else "ray"


def _length_in_words(absolute: float, relative: float, largest: str) -> str:
    if absolute == relative and absolute > 0.0:
        return f"{absolute:.3g}·(1 + {largest})"
    terms = [f"{absolute:.3g}"] if absolute > 0.0 else []
    return " + ".join([*terms, *([f"{relative:.3g}·{largest}"] if relative > 0.0 else [])])
