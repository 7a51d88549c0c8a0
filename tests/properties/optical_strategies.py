"""Angles and indices at the ends of their ranges, drawn so that the rare cases are not rare.

tests/meta/test_optical_generators.py proves that each of them is reached.
"""

from __future__ import annotations

from math import nextafter, sqrt

from hypothesis import strategies as st

MOST_ULPS = 8
SMALLEST_SUBNORMAL = 5e-324


def moved(x: float, ulps: int) -> float:
    """The float that many units in the last place further from 0, or nearer to it for a negative number of them."""
    for _ in range(abs(ulps)):
        x = nextafter(x, 2 * x if ulps > 0 else 0.0)
    return x


# What a scene may state, between SMALLEST_INDEX and its inverse, and the nearest neighbours of 1 on both sides.
EXTREME_RATIOS = st.one_of(
    st.sampled_from([1.5, 1 / 1.5, 1.0, 1e-6, 1e6, 1e-3, 1e3, 1.0 + 2.0**-52, 1.0 - 2.0**-53]),
    st.builds(lambda sign, exponent: 1.0 + sign * 10.0**-exponent, st.sampled_from([1.0, -1.0]), st.floats(1.0, 15.0)),
    st.builds(lambda exponent: 10.0**exponent, st.floats(-6.0, 6.0)),
)

# Grazing to head on. The cosine of two unit vectors, each rounded, may exceed 1 by some units.
EXTREME_COSINES = st.one_of(
    st.sampled_from([1.0, 0.5, 0.0, -0.0, SMALLEST_SUBNORMAL, 2.0**-1022, 1e-200, 1e-162, 1e-154, 1e-16, 1e-8]),
    st.sampled_from([moved(1.0, ulps) for ulps in range(-4, 5)]),
    st.builds(lambda exponent: 10.0**exponent, st.floats(-20.0, 0.0)),
)


@st.composite
def incidences(draw: st.DrawFn) -> tuple[float, float]:
    """A cosine and an index ratio: each extreme, or within 8 ulp of the critical angle where there is one."""
    ratio = draw(EXTREME_RATIOS)
    if ratio < 1.0 and draw(st.booleans()):
        critical = sqrt((1.0 - ratio) * (1.0 + ratio))
        return moved(critical, draw(st.integers(-MOST_ULPS, MOST_ULPS))), ratio
    return draw(EXTREME_COSINES), ratio


# Lengths whose squares are numbers: from next to no distance to the ends of a scene of LARGEST_COORDINATE.
DISTANCES = st.one_of(
    st.sampled_from([1.0, 1e-150, 1e-12, 1e-6, 1e6, 1e12, 3.5e12, 0.0]),
    st.builds(lambda exponent: 10.0**exponent, st.floats(-12.0, 12.0)),
)
# The exponents that a scene may state, up to a mirror-like highlight, and 0 < n < 1, which is broader than any matt.
EXPONENTS = st.one_of(st.sampled_from([1.0, 2.0, 1e6, 0.5, 1e-6, 1e12]), st.floats(1e-3, 1e6))
NOT_NUMBERS = st.sampled_from([float("nan"), float("inf"), -float("inf")])
