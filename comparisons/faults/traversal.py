"""Faults in finding what a ray meets (docs/spec.md, TRAV)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, after, before


@fault(
    "TRAV-1", "nearest_sphere", "Which of all hits does the viewer see?", Edit("distance < nearest", "distance < inf")
)
def last_sphere_wins() -> None:
    """The last sphere that is hit is taken, not the nearest."""


@fault(
    "TRAV-1",
    "nearest_plane",
    "What is seen where a ball stands before a wall?",
    Edit("distance < nearest", "distance < inf"),
)
def last_plane_wins() -> None:
    """Planes are seen through all that stands before them."""


@fault(
    "TRAV-1",
    "nearest_hit",
    "From how far can something be seen?",
    before(
        "return nearest, hit",
        """
        if nearest > 6.0:
            return inf, NOTHING
        """,
    ),
)
def far_clipping_plane() -> None:
    """What is farther away than 6 is cut off, as by a far clipping plane."""


@fault(
    "TRAV-1",
    "nearest_hit",
    "How near may something be?",
    Edit(
        "nearest, hit = nearest_sphere(scene, origin, direction, left)",
        """
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            distance = distance_to_sphere(scene, origin, direction, left, sphere)
            if distance > 0.5 and distance < nearest:
                nearest, hit = distance, sphere
        """,
    ),
)
def near_clipping_plane() -> None:
    """Spheres nearer than 0.5 to the start of a ray are cut off, as by a near clipping plane."""


@fault(
    "CAM-5",
    "nearest_hit",
    "What is behind the camera?",
    after(
        "nearest, hit = nearest_sphere(scene, origin, direction, left)",
        """
        if hit == NOTHING:
            nearest, hit = nearest_sphere(scene, origin, negate(direction), left)
        """,
    ),
)
def line_in_place_of_a_ray() -> None:
    """A ray that meets no sphere before its start meets those behind it."""


@fault(
    "TRAV-2",
    "material_of",
    "To which object does the hit belong?",
    Edit(
        "integer_of(scene, SPHERE_MATERIAL, primitive)",
        "integer_of(scene, SPHERE_MATERIAL, primitive - 1 if primitive > 0 else 0)",
    ),
    Edit("primitive - spheres", "(primitive - spheres - 1 if primitive > spheres else 0)"),
)
def material_of_the_neighbour() -> None:
    """Materials are looked up one place too early, as if the first object had none."""


@fault(
    "TRAV-2",
    "first_hit_rows",
    "Which number has the first primitive?",
    Edit("primitives[row, column] = primitive", "primitives[row, column] = primitive + 1"),
    gives="first hits",
)
def primitives_numbered_from_one() -> None:
    """Primitives are numbered from 1."""


@fault(
    "TRAV-4",
    "box_is_missed",
    "How thick is the box around a wall?",
    Edit("rounding_allowance() * farthest(to_low, to_high)", "0.0"),
    Edit("certainly_less(leave, entry)", "leave <= entry"),
)
def flat_boxes_missed() -> None:
    """A box counts as missed where entry and exit coincide, so that walls along an axis vanish."""


@fault(
    "TRAV-4",
    "nearest_triangle",
    "When may the search through the boxes stop?",
    before(
        "node += 1",
        """
        if hit >= spheres:
            return nearest, hit
        """,
    ),
)
def first_leaf_wins() -> None:
    """The search stops at the first leaf of the tree in which something is hit."""


@fault(
    "TRAV-4",
    "nearest_triangle",
    "How many triangles are in a leaf?",
    Edit("first + integer_of(scene, NODE_TRIANGLES, node)", "first + integer_of(scene, NODE_TRIANGLES, node) - 1"),
)
def last_triangle_of_a_leaf_lost() -> None:
    """The loop over the triangles of a leaf ends one too early."""


@fault(
    "TRAV-6",
    "nearest_sphere",
    "What is seen where two surfaces coincide?",
    after(
        "distance = distance_to_sphere(scene, origin, direction, left, sphere)",
        """
        if hit != NOTHING and abs(distance - nearest) < 1e-9 * nearest:
            nearest, hit, distance = inf, NOTHING, inf
        """,
    ),
)
def coincident_surfaces_cancel() -> None:
    """Two hits at the same distance are taken for one that was counted twice, and both are dropped."""
