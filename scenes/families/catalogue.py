"""The table of all families, and scenes of them by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.families import contacts, drawn, language, lights, optics, planes, sizes

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Family:
    """Scenes of one kind: how to build one from a parameter and a seed, and which parameters to try."""

    build: Callable[[float, int], Scene]
    parameters: tuple[float, ...]
    ties: frozenset[float] = frozenset()
    """Parameters at which pixels are ties, exactly or within the rounding of float64: the tie is the point."""

    @property
    def about(self) -> str:
        """What is extreme, and what the specification demands there."""
        return self.build.__doc__ or ""


def _powers(*exponents: int) -> tuple[float, ...]:
    # From the decimal text: 10.0**-6 is not the float nearest to 1e-6.
    return tuple(float(f"1e{exponent}") for exponent in exponents)


def _both_signs(*sizes: float) -> tuple[float, ...]:
    return tuple(sign * size for size in sizes for sign in (1.0, -1.0))


ULP = 2.0**-52
"""The unit in the last place of 1; families of ulps use small multiples of it."""

FAMILIES: dict[str, Family] = {
    # Every 25th of the rows of its covering array, for all of which there is `raytruth run --families`.
    "language": Family(language.language, tuple(float(row) for row in range(0, 175, 25))),
    "drawn": Family(drawn.drawn, _powers(-4, -2, 0, 2, 4)),
    "scale": Family(sizes.scale, _powers(-9, -6, -3, 0, 3, 6, 9)),
    "sphere-size": Family(sizes.sphere_size, _powers(-5, -3, -1, 0, 1, 3, 5, 7)),
    "above-huge-sphere": Family(sizes.above_huge_sphere, _powers(3, 5, 7)),
    "huge-triangle": Family(sizes.huge_triangle, _powers(3, 6, 9, 11)),
    "needle": Family(sizes.needle, _powers(-2, -4, -6, -8, -10, -12)),
    "tangent": Family(contacts.tangent, (0.0, *_both_signs(4 * ULP, 1e-12, 1e-6)), frozenset({0.0, 4 * ULP, -4 * ULP})),
    "coplanar": Family(contacts.coplanar, (0.0, *_both_signs(1e-12, 1e-6, 1e-3)), frozenset({0.0})),
    "coincident-spheres": Family(contacts.coincident_spheres, (0.0, 1e-12, 1e-9, 1e-6), frozenset({0.0})),
    "fan": Family(contacts.fan, (4.0, 8.0, 16.0, 32.0), frozenset({4.0, 8.0, 16.0, 32.0})),
    "camera-near-surface": Family(
        contacts.camera_near_surface, (0.0, *_both_signs(2 * ULP, 1e-12, 1e-6)), frozenset({0.0, 2 * ULP, -2 * ULP})
    ),
    "camera-near-plane": Family(planes.camera_near_plane, (0.0, *_both_signs(1e-12, 1e-6, 1.0)), frozenset({0.0})),
    "grazing-plane": Family(planes.grazing_plane, _powers(0, -2, -4, -6)),
    "plane-stated-from-afar": Family(planes.plane_stated_from_afar, _powers(0, 3, 6, 9)),
    "light-near-surface": Family(lights.light_near_surface, (0.0, *_both_signs(1e-12, 1e-6, 1e-2)), frozenset({0.0})),
    "light-inside-sphere": Family(lights.light_inside_sphere, (0.0, 0.5, 1 - 1e-6, 1 - 1e-12)),
    "light-inside-tetrahedron": Family(
        lights.light_inside_tetrahedron, (1.0, 1e-3, 1e-6), frozenset({1.0, 1e-3, 1e-6})
    ),
    "distant-light": Family(lights.distant_light, _powers(1, 3, 6, 9)),
    "index-ratio": Family(optics.index_ratio, (1e-3, 1 - 1e-6, 1.0, 1 + 1e-6, 1e3)),
    "critical-angle": Family(
        optics.critical_angle, tuple(float(ulps) for ulps in range(-8, 9)), frozenset(map(float, range(-8, 9)))
    ),
    "camera-inside-glass": Family(optics.camera_inside_glass, (0.0, 0.5, 1 - 1e-3, 1 - 1e-9)),
    "mirror-corridor": Family(optics.mirror_corridor, (1.0, 10.0, 50.0)),
    "nested-dielectrics": Family(optics.nested_dielectrics, (1.0, 2.0, 3.0)),
}


def family(name: str, parameter: float, seed: int = 0) -> Scene:
    """The scene of a family for a parameter, which should be one of the family's, and a seed.

    Raises KeyError for a name that FAMILIES does not have.
    """
    return FAMILIES[name].build(parameter, seed)
