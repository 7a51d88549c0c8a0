"""Rays and what they meet, drawn so that the rare cases are not rare, as tests/meta/test_generators.py proves.

Floats have no subnormal parts and lie between 1e-12 and 1e12 in size, so that no product of four underflows: the bounds
on rounding in exact.py hold.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import permutations, product
from math import cos, inf, nan, sin, sqrt, tau, ulp
from typing import Any, NamedTuple

from hypothesis import strategies as st

from tests.properties.exact import Exact, cross, plus, times

Vector = tuple[float, float, float]

# Endpoints first: hypothesis reduces failures towards them.
SCALES = st.sampled_from([1.0, 1e-6, 1e6, 1e-3, 1e3, 0.7, 13.0])
SIGNS = st.sampled_from([1.0, -1.0])
PARTS = st.one_of(st.sampled_from([0.0, 1.0, 0.5, 0.6, 0.8, 1e-3]), st.floats(1e-3, 1.0))
CUBE_SYMMETRIES = [(order, signs) for order in permutations(range(3)) for signs in product((1, -1), repeat=3)]
"""An order of the axes, and a sign for each."""
AXIS_MAPS = st.sampled_from(CUBE_SYMMETRIES)


class Ray(NamedTuple):
    origin: Vector
    direction: Vector


class Sphere(NamedTuple):
    center: Vector
    radius: float


Corners = tuple[Vector, Vector, Vector]


def mapped(vector: Any, axis_map: tuple[tuple[int, ...], tuple[int, ...]]) -> Any:
    """The vector, of any number type, with its axes in another order and mirrored."""
    order, signs = axis_map
    x, y, z = (signs[axis] * vector[order[axis]] for axis in range(3))
    return x, y, z


def float_cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def combined(a: Vector, b: Vector, factor: float) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@st.composite
def vectors(draw: st.DrawFn, scale: float = 1.0) -> Vector:
    x, y, z = (draw(SIGNS) * draw(PARTS) * scale for _ in range(3))
    return x, y, z


@st.composite
def directions(draw: st.DrawFn) -> Vector:
    """Unit vectors within rounding, in all octants and along the axes."""
    x, y, z = draw(vectors().filter(any))
    size = sqrt(x * x + y * y + z * z)
    return x / size, y / size, z / size


@st.composite
def perpendiculars(draw: st.DrawFn, direction: Vector) -> Vector:
    """Unit vectors at a right angle to a direction, within rounding."""
    smallest = min(range(3), key=lambda axis: abs(direction[axis]))
    x, y, z = float_cross(direction, tuple(float(axis == smallest) for axis in range(3)))  # type: ignore[arg-type]
    size = sqrt(x * x + y * y + z * z)
    side = (x / size, y / size, z / size)
    return draw(st.sampled_from([side, combined((0.0, 0.0, 0.0), side, -1.0), float_cross(direction, side)]))


# How far the ray passes from the centre, in radii: through it, inside, nearly tangent, tangent, outside.
PASSING_DISTANCES = st.one_of(
    st.sampled_from([0.5, 0.0, 1.0, 1.0 - 2.0**-50, 1.0 + 2.0**-50, 1.0 - 2.0**-30, 1.0 + 2.0**-30, 1.5]),
    st.floats(0.0, 2.0, allow_subnormal=False),
)
# Where the ray starts, in radii before the point closest to the centre.
DISTANCES_BEFORE = st.one_of(st.sampled_from([3.0, 0.0, 0.5, -0.5, -3.0, 1.0, -1.0, 1e3]), st.floats(-2.0, 5.0))


@st.composite
def spheres(draw: st.DrawFn) -> Sphere:
    scale = draw(SCALES)
    return Sphere(draw(vectors(scale)), scale * draw(st.sampled_from([1.0, 0.25, 30.0, 0.3])))


@st.composite
def untidy_rays_near_spheres(draw: st.DrawFn) -> tuple[Ray, Sphere]:
    sphere = draw(spheres())
    direction = draw(directions())
    side = draw(perpendiculars(direction))
    closest = combined(sphere.center, side, draw(PASSING_DISTANCES) * sphere.radius)
    origin = combined(closest, direction, -draw(DISTANCES_BEFORE) * sphere.radius)
    return Ray(origin, combined((0.0, 0.0, 0.0), direction, draw(st.sampled_from([1.0, 0.125, 7.3])))), sphere


# Whole multiples of a power of 2, with which sums and products are exact: ties are then ties.
TIDY_SCALES = st.sampled_from([1.0, 2.0**-20, 2.0**20])


@st.composite
def tidy_vectors(draw: st.DrawFn, scale: float = 1.0) -> Vector:
    x, y, z = (scale * draw(st.integers(-3, 3)) for _ in range(3))
    return x, y, z


@st.composite
def tidy_rays_near_spheres(draw: st.DrawFn) -> tuple[Ray, Sphere]:
    """Along an axis, with exact distances: exactly tangent, or exactly from the surface."""
    scale, sign, (order, _) = draw(TIDY_SCALES), draw(SIGNS), draw(AXIS_MAPS)
    radius = scale * draw(st.sampled_from([1.0, 0.25, 32.0]))
    center = draw(tidy_vectors(scale))
    direction, side = (mapped(axis, (order, (1, 1, 1))) for axis in ((sign, 0.0, 0.0), (0.0, 1.0, 0.0)))
    closest = combined(center, side, radius * draw(st.sampled_from([1.0, 0.0, 0.5, 2.0])))
    return Ray(combined(closest, direction, -radius * draw(st.sampled_from([3.0, 1.0, 0.0, -1.0]))), direction), Sphere(
        center, radius
    )


# Radii up to a planet's in metres; the smallest ones are a hundredth of a millimetre.
RADII = st.sampled_from([1.0, 1e7, 1e5, 1e-5, 6.371e6])
# How high above the surface, in units of length, or in ulps of the coordinates.
HEIGHTS = st.sampled_from([1.0, 1e-3, -1e-3, 30.0, 0.0])
ULPS = st.integers(-8, 8)


@st.composite
def rays_close_to_spheres(draw: st.DrawFn) -> tuple[Ray, Sphere]:
    """From just above, on, or just under a sphere, huge ones too: downwards, tangent, and upwards."""
    radius = draw(RADII)
    center = draw(st.one_of(st.just((0.0, 0.0, 0.0)), vectors(1.0), vectors(radius)))
    up = draw(directions())
    x, y, z = combined(center, up, radius + draw(HEIGHTS) * min(1.0, radius))
    shift = draw(ULPS)
    origin = (x + shift * ulp(x), y, z)
    side = draw(perpendiculars(up))
    direction = combined(side, up, draw(st.sampled_from([0.0, -1e3, -1.0, -1e-2, -1e-4, 1e-4, 1.0])))
    return Ray(origin, direction), Sphere(center, radius)


def rays_near_spheres() -> st.SearchStrategy[tuple[Ray, Sphere]]:
    return st.one_of(untidy_rays_near_spheres(), rays_close_to_spheres(), tidy_rays_near_spheres())


SIDES = st.one_of(st.sampled_from([1.0, 1e-3, 30.0]), st.floats(1e-3, 3.0))


@st.composite
def triangles(draw: st.DrawFn) -> Corners:
    """Of all shapes, flat ones included, of every orientation and size; few of zero area."""
    scale = draw(SCALES)
    a = draw(vectors(scale))
    along = draw(directions())
    across = combined(draw(perpendiculars(along)), along, draw(st.sampled_from([0.0, 0.5, -3.0])))
    width, height = draw(SIDES) * scale, draw(SIDES) * scale * (draw(st.integers(0, 15)) != 15)
    return a, combined(a, along, width), combined(a, across, height)


# Barycentric coordinates u and v: inside, on edges, at corners, just beside an edge, outside.
PARTS_OF_EDGES = st.one_of(st.sampled_from([0.25, 0.0, 1.0, 0.5]), st.floats(0.0, 1.0, allow_subnormal=False))
INSIDE = st.builds(lambda u, v: (u, (1.0 - u) * v), PARTS_OF_EDGES, PARTS_OF_EDGES)
BESIDE = st.sampled_from([-0.25, 2.0**-50, -(2.0**-50), 1.25, 0.5])
ANYWHERE = st.one_of(INSIDE, st.tuples(BESIDE, BESIDE))
# Beside the edges by little, but mostly by more than rounding: what is hit is then no matter of luck.
CLEAR_PARTS = st.sampled_from([0.25, 0.5, 2.0**-40, -(2.0**-40), 2.0**-20, -(2.0**-20), 0.75, -0.25, 1.0 - 2.0**-40])
CLEAR_OF_EDGES = st.one_of(
    st.tuples(CLEAR_PARTS, CLEAR_PARTS), st.builds(lambda u, v: (u, (1.0 - u) * v), *[st.floats(1e-6, 1.0 - 1e-6)] * 2)
)


@st.composite
def tidy_rays_near_triangles(draw: st.DrawFn) -> tuple[Ray, Corners]:
    """At points of the triangle that are exact: on its edges, at its corners, in its middle."""
    scale = draw(TIDY_SCALES)
    a, b, c = (draw(tidy_vectors(scale)) for _ in range(3))
    u, v = draw(st.sampled_from([(0.0, 0.5), (0.0, 0.0), (0.5, 0.5), (0.25, 0.25), (1.0, 0.0)]))
    target = combined(combined(combined(a, a, -u - v), b, u), c, v)
    toward = draw(tidy_vectors(scale).filter(any))
    return Ray(combined(target, toward, -draw(st.sampled_from([1.0, 0.5]))), toward), (a, b, c)


@st.composite
def rays_near_triangles(
    draw: st.DrawFn, positions: st.SearchStrategy[tuple[float, float]] = ANYWHERE
) -> tuple[Ray, Corners]:
    """Aimed at a point of the triangle's plane, from either side, or away from it."""
    if draw(st.integers(0, 3)) == 3:
        return draw(tidy_rays_near_triangles())
    a, b, c = draw(triangles())
    u, v = draw(positions)
    target = combined(combined(combined(a, a, -u - v), b, u), c, v)
    size = max(abs(part) for corner in (a, b, c) for part in corner) or 1.0
    toward = combined((0.0, 0.0, 0.0), draw(directions()), draw(st.sampled_from([1.0, 0.125, 7.3])) * size)
    starts = st.sampled_from([1.0, 0.5, 20.0] if positions is INSIDE else [1.0, 0.5, 20.0, -1.0])
    return Ray(combined(target, toward, -draw(starts)), toward), (a, b, c)


Fan = tuple[Vector, ...]
"""The hub, then the rim, which ends where it begins."""


@st.composite
def rays_at_fans(draw: st.DrawFn) -> tuple[Ray, Fan]:
    """At the hub, at a spoke, or between spokes of a fan of triangles that surrounds the point.

    Seen along the ray the rim runs around that point at a distance, so that the ray meets one of the triangles; some of
    its corners may be far behind, which is no matter of where they are seen, and such triangles are seen edge on.
    """
    scale = draw(SCALES)
    hub = draw(vectors(scale))
    axis = draw(directions())
    first = draw(perpendiculars(axis))
    second = float_cross(axis, first)
    corners = draw(st.integers(3, 8))
    rim = [
        combined(combined(hub, first, scale * cos(tau * i / corners)), second, scale * sin(tau * i / corners))
        for i in range(corners)
    ]
    # At a third of the spoke: no nearer to the rim of a triangle than a sixth of it.
    part = draw(st.sampled_from([0.0, 1 / 3, 0.1, 1e-3, 1e-9]))
    spoke = combined(rim[0], hub, -1.0)
    beside = draw(st.sampled_from([0.0, 2.0**-52, -(2.0**-52), 2.0**-23, -(2.0**-23), 1e-9]))
    target = combined(combined(hub, spoke, part), second, beside * scale)
    tilt = draw(st.sampled_from([0.0, 1.0, -3.0]))
    toward = combined(combined((0.0, 0.0, 0.0), axis, draw(SIGNS)), first, tilt)
    away = scale * draw(st.sampled_from([1.0, 0.37, 20.0]))
    rim = [combined(corner, toward, scale * draw(st.sampled_from([0.0, 1.0, 1e2, 1e4]))) for corner in rim]
    return Ray(combined(target, toward, -away), toward), (hub, *rim, rim[0])


# Where between the faces of a box.
BOX_PARTS = st.one_of(st.sampled_from([0.5, 0.0, 1.0, 1.5, -0.5, 1.0 + 2.0**-50]), st.floats(0.0, 1.0))

# With these, squares and products overflow, vanish or are no numbers.
STRANGE = st.sampled_from([0.0, -0.0, 1.0, -2.5, 5e-324, -1e-310, 1e-170, 1e170, -1.7e308, inf, -inf, nan])
STRANGE_VECTORS = st.tuples(STRANGE, STRANGE, STRANGE)

# Rational numbers with small denominators, negative ones and 0 too.
SMALL_FRACTIONS = st.builds(Fraction, st.integers(-12, 12), st.integers(1, 12))


@st.composite
def rational_unit_vectors(draw: st.DrawFn) -> Exact:
    """Points of the unit sphere with rational coordinates, by stereographic projection; all octants."""
    x, y = draw(SMALL_FRACTIONS), draw(SMALL_FRACTIONS)
    squared = x * x + y * y
    point = (2 * x / (1 + squared), 2 * y / (1 + squared), (1 - squared) / (1 + squared))
    order, signs = draw(AXIS_MAPS)
    return point[order[0]] * signs[0], point[order[1]] * signs[1], point[order[2]] * signs[2]


@st.composite
def rational_frames(draw: st.DrawFn) -> tuple[Exact, Exact, Exact]:
    """Three perpendicular rational unit vectors, right-handed: a rational quaternion's rotation."""
    w, x, y, z = draw(st.tuples(*[st.integers(-5, 5)] * 4).filter(any))
    size = Fraction(w * w + x * x + y * y + z * z)
    first = ((w * w + x * x - y * y - z * z) / size, 2 * (x * y + w * z) / size, 2 * (x * z - w * y) / size)
    second = (2 * (x * y - w * z) / size, (w * w - x * x + y * y - z * z) / size, 2 * (y * z + w * x) / size)
    return first, second, cross(first, second)


class Refraction(NamedTuple):
    """All that belongs to one refracted ray, in rational numbers."""

    direction: Exact
    normal: Exact
    cosine: Fraction
    ratio: Fraction
    g: Fraction
    tangent: Exact
    """The unit vector in the surface towards which the ray goes."""
    sine: Fraction


ANGLE_PARAMETERS = st.one_of(
    st.sampled_from([Fraction(1, 2), Fraction(1), Fraction(1, 1000), Fraction(999, 1000)]),
    st.builds(lambda a, b: Fraction(min(a, b), max(a, b)), st.integers(1, 60), st.integers(1, 60)),
)
"""t = tan(θ/2) in (0, 1], so that sin θ = 2t/(1+t²) and cos θ = (1-t²)/(1+t²) are rational."""


@st.composite
def rational_refractions(draw: st.DrawFn) -> Refraction:
    """Both angles have rational sines and cosines; so has the index ratio, their quotient."""
    normal, tangent, _ = draw(rational_frames())
    before, beyond = draw(ANGLE_PARAMETERS), draw(ANGLE_PARAMETERS)
    sine, cosine = 2 * before / (1 + before**2), (1 - before**2) / (1 + before**2)
    ratio = sine / (2 * beyond / (1 + beyond**2))
    g = ratio * (1 - beyond**2) / (1 + beyond**2)
    return Refraction(plus(times(normal, -cosine), times(tangent, sine)), normal, cosine, ratio, g, tangent, sine)


# All that a scene may state, and where rounding is worst: nearly equal indices.
INDEX_RATIOS = st.one_of(
    st.sampled_from([1.5, 1 / 1.5, 1.0, 1e-6, 1e6, 1.0 + 2.0**-40, 1.0 - 2.0**-40]), st.floats(0.2, 5.0)
)


@st.composite
def cosines_and_ratios(draw: st.DrawFn) -> tuple[float, float]:
    """A cosine of incidence in (0, 1] and an index ratio; around the critical angle where there is one."""
    ratio = draw(INDEX_RATIOS)
    cosine = draw(st.one_of(st.sampled_from([1.0, 0.5, 1e-6]), st.floats(1e-6, 1.0)))
    if ratio < 1.0 and draw(st.booleans()):
        near = draw(st.sampled_from([0.0, 2.0**-52, -(2.0**-52), 1e-9, -1e-9]))
        cosine = min(1.0, max(1e-6, sqrt((1.0 - ratio) * (1.0 + ratio)) * (1.0 + near)))
    return cosine, ratio
