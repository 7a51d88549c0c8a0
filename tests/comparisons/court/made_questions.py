"""Questions that are drawn: closed fans of triangles around a corner, and boxes."""

from __future__ import annotations

from hypothesis import strategies as st

from raytruth.comparisons.court.questions import Question

# Coordinates on a grid of 2^-10 between -4 and 4 are exact in float32, and so are their differences and halves.
GRID = 2.0**-10
on_grid = st.integers(-4096, 4096).map(lambda steps: steps * GRID)
above = st.integers(5120, 8192).map(lambda steps: steps * GRID)

Corner = tuple[float, float, float]
Triangle = tuple[Corner, Corner, Corner]

# Corners of a square around the middle, seen from above; their heights are drawn.
SQUARE = ((4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0), (4.0, -4.0))


@st.composite
def fans(draw: st.DrawFn) -> tuple[Corner, list[Triangle]]:
    """A corner, and four triangles around it that no ray from above passes beside."""
    near = st.integers(-512, 512).map(lambda steps: steps * GRID)
    corner = (draw(near), draw(near), draw(near))
    ring: list[Corner] = [(x, y, draw(near)) for x, y in SQUARE]
    return corner, [(corner, ring[index], ring[(index + 1) % 4]) for index in range(4)]


def ray_to(target: Corner, origin: Corner, triangles: list[Triangle]) -> Question:
    """A ray whose direction is exact, so that it runs through the target."""
    x, y, z = (end - start for start, end in zip(origin, target, strict=True))
    return Question(origin=origin, direction=(x, y, z), triangles=tuple(triangles))


@st.composite
def rays_through_corners(draw: st.DrawFn) -> Question:
    """A ray from above through the corner that four triangles share."""
    corner, triangles = draw(fans())
    return ray_to(corner, (draw(on_grid), draw(on_grid), draw(above)), triangles)


@st.composite
def rays_at_boxes(draw: st.DrawFn) -> Question:
    """Rays with many zeros, whose starts lie often in the planes of faces; boxes that are often flat."""
    small = st.integers(-3, 3).map(float)
    ends = [sorted((draw(small), draw(small))) for _ in range(3)]
    direction = draw(st.tuples(small, small, small).filter(any))
    start = draw(st.tuples(small, small, small))
    (x, u), (y, v), (z, w) = ends
    return Question(origin=start, direction=direction, box=((x, y, z), (u, v, w)))
