"""The worst rays found for spheres: bits lost of 53 by the tracer's form, the textbook's and Haines'.

| ray | found by | tracer | b² - 4ac | perpendicular |
|---|---|---|---|---|
| down from 1 above a sphere of radius 1e7 | best of 3,000 random rays | 2.1 | 21.9 | 12.7 |
| at 45° from 1e-3 above it | best of 3,000 random rays | 2.2 | 32.8 | 31.7 |
| from 1e-3 inside it | best of 3,000 random rays | 2.1 | 1.4 | 0.0 |
| at a unit sphere from 1e7 | best of 3,000 random rays | 2.2 | 25.2 | 2.2 |
"""

from __future__ import annotations

from fractions import Fraction

import pytest

from raytruth.reference_tracer.arithmetics.textbook_forms import (
    perpendicular_sphere_distance,
    quadratic_sphere_distance,
)
from raytruth.reference_tracer.source.sphere import sphere_distance
from tests.properties.exact import bits, root_above
from tests.properties.strategies import Ray, Sphere, Vector
from tests.properties.test_sphere import Meeting

pytestmark = pytest.mark.clause("SPH-1")


def vector(*parts: str) -> Vector:
    x, y, z = map(float.fromhex, parts)
    return x, y, z


HUGE = Sphere((0.0, 0.0, 0.0), 1e7)
# The ray, the sphere, and the bits that the three forms lose, rounded up and down.
WORST = {
    "steeply down from 1 above": (
        Ray(
            vector("-0x1.162768e8d221fp+23", "-0x1.a15e8e96fd4bep+21", "-0x1.174b5dd68311ep+21"),
            vector("0x1.c26a42887de3ap-1", "0x1.be30cc7b74280p-2", "0x1.b85de43317566p-3"),
        ),
        HUGE,
        (2.2, 21.8, 12.6),
    ),
    "at 45 degrees from a thousandth above": (
        Ray(
            vector("0x1.fb2e8ff16c77fp+21", "-0x1.af24914775719p+22", "0x1.5dc430de7e388p+22"),
            vector("-0x1.f3928715462ffp-2", "0x1.4f0858c7b8cd6p+0", "0x1.c671bd4e5b7a0p-3"),
        ),
        HUGE,
        (2.3, 32.7, 31.6),
    ),
    "from a thousandth inside": (
        Ray(
            vector("-0x1.28def3bec4147p+23", "0x1.10e1c723504cfp+21", "0x1.29919bcb7e9aap+19"),
            vector("0x1.80a63352ab555p-1", "-0x1.32acd0135b4e1p+0", "-0x1.734c99e5ae930p-6"),
        ),
        HUGE,
        (2.2, 1.3, 0.0),
    ),
    "from afar": (
        Ray(
            vector("0x1.8d23c4c183451p+21", "0x1.1835541b33491p+23", "-0x1.13ea2f4cc93f0p+21"),
            vector("-0x1.4d25182a62ffap-2", "-0x1.d61c8e438dc3fp-1", "0x1.cee8839154ec9p-3"),
        ),
        Sphere((0.0, 0.0, 0.0), 1.0),
        (2.3, 25.1, 2.1),
    ),
}


@pytest.mark.parametrize("name", WORST)
def test_the_worst_rays_lose_no_more_bits_than_found_and_the_textbooks_forms_no_fewer(name: str) -> None:
    ray, sphere, (most, *least) = WORST[name]
    meeting = Meeting(ray, sphere)
    # The roots with 100 bits more than a float has.
    half_chord = root_above(meeting.gap / meeting.squared)
    foot = -meeting.half_linear / meeting.squared
    ideal = foot - half_chord if meeting.constant > 0 else foot + half_chord

    def lost(distance: float) -> float:
        return bits(abs(Fraction(distance) - ideal), ideal)

    arguments = (ray.origin, ray.direction, sphere.center, sphere.radius)
    distance = sphere_distance(*arguments)
    assert lost(distance) <= most
    assert abs(meeting.residual(distance)) <= meeting.residual_doubt(distance)
    assert lost(quadratic_sphere_distance(*arguments)) >= least[0]
    assert lost(perpendicular_sphere_distance(*arguments)) >= least[1]
