"""Legitimate variants by the order of the work: what is looked at first, and what is summed first."""

from __future__ import annotations

from raytruth.comparisons.faults.other_formulas import variant
from raytruth.reference_tracer.arithmetics.edits import Edit


@variant(
    "nearest_sphere",
    Edit("range(rows_of(scene, SPHERE_RADIUS))", "range(rows_of(scene, SPHERE_RADIUS) - 1, -1, -1)"),
    Edit("distance < nearest", "distance <= nearest and distance < inf"),
)
def spheres_from_last_to_first() -> None:
    """The spheres are tested in reverse order."""


@variant(
    "nearest_triangle",
    Edit("node = 0", "node = rows_of(scene, NODE_END) - 1"),
    Edit("node < rows_of(scene, NODE_END)", "node >= 0"),
    Edit("node = integer_of(scene, NODE_END, node)", "node -= 1"),
    Edit("node += 1", "node -= 1"),
    Edit("range(rows_of(scene, TRIANGLE_MATERIAL))", "range(rows_of(scene, TRIANGLE_MATERIAL) - 1, -1, -1)"),
)
def boxes_from_last_to_first() -> None:
    """The leaves of the tree of boxes are visited in reverse order."""


@variant(
    "nearest_triangle",
    Edit(
        """
        box_is_missed(
            origin, direction, vector_of(scene, NODE_LOW, node), vector_of(scene, NODE_HIGH, node), nearest
        )
        """,
        """
        box_is_missed(
            origin, direction, vector_of(scene, NODE_LOW, node), vector_of(scene, NODE_HIGH, node), inf
        )
        """,
    ),
)
def boxes_behind_a_hit_entered() -> None:
    """Boxes are entered although something nearer has been hit already."""


@variant("radiance", Edit("waiting.pop()", "waiting.pop(0)"))
def breadth_first() -> None:
    """The rays of the tree are followed, and summed, in the order in which they were sent on."""
