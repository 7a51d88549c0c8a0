"""Questions with drawn numbers, as JSON states them."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

# Multiples of a power of two that float32 holds, so that both arithmetics are asked the same.
NUMBERS = st.integers(-(2**10), 2**10).map(lambda number: number / 2**7)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS).map(list)
DIRECTIONS = VECTORS.filter(any)
INDICES = st.integers(128, 320).map(lambda number: number / 128)
RAYS = {"origin": VECTORS, "direction": DIRECTIONS}
SURFACE = {"direction": DIRECTIONS, "normal": DIRECTIONS}
COLORS = st.just([0.5, 0.25, 0.75])
MATERIALS = st.fixed_dictionaries(
    {"diffuse": st.fixed_dictionaries({"reflectance": COLORS})},
    optional={
        "specular": st.fixed_dictionaries(
            {"reflectance": COLORS, "exponent": st.just(8.0), "model": st.sampled_from(["phong", "blinn"])}
        )
    },
)
LIGHTS = st.lists(
    st.fixed_dictionaries(
        {
            "kind": st.just("point"),
            "position": VECTORS,
            "intensity": COLORS,
            "falloff": st.sampled_from(["none", "inverse_square"]),
        }
    ),
    min_size=1,
    max_size=2,
)


def _is_no_line(question: dict[str, Any]) -> bool:
    """Whether the corners of a triangle do not lie on a line: exact, of such numbers."""
    first, second = ([x - y for x, y in zip(question[corner], question["a"], strict=True)] for corner in ("b", "c"))
    return any(first[i] * second[j] != first[j] * second[i] for i, j in ((0, 1), (1, 2), (2, 0)))


def _asked(name: str, **keys: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries({"ask": st.just(name), **keys})


SPHERES = _asked("intersect_sphere", **RAYS, center=VECTORS, radius=st.integers(1, 512).map(lambda it: it / 2**7))
TRIANGLES = _asked("intersect_triangle", **RAYS, a=VECTORS, b=VECTORS, c=VECTORS).filter(_is_no_line)
PLANES = _asked("intersect_plane", **RAYS, point=VECTORS, normal=DIRECTIONS)
BOXES = st.builds(
    lambda ray, one, other: {
        "ask": "intersect_box",
        **ray,
        "low": list(map(min, one, other)),
        "high": list(map(max, one, other)),
    },
    st.fixed_dictionaries(RAYS),
    VECTORS,
    VECTORS,
)
REFLECTIONS = _asked("reflect", **SURFACE)
REFRACTIONS = _asked("refract", **SURFACE, index_from=INDICES, index_to=INDICES)
FRESNEL = _asked("fresnel", cosine=st.integers(0, 128).map(lambda it: it / 128), index_from=INDICES, index_to=INDICES)
SHADES = _asked("shade", **SURFACE, convention=st.just("whitted"), point=VECTORS, material=MATERIALS, lights=LIGHTS)
QUESTIONS = st.one_of(SPHERES, TRIANGLES, PLANES, BOXES, REFLECTIONS, REFRACTIONS, FRESNEL, SHADES)
