"""Faults of the ray tree (docs/spec.md, TREE)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, at_the_start, before


@fault(
    "TREE-1",
    "direct_light",
    "Which terms does the equation have for a surface that mirrors?",
    at_the_start("""
        if MIRRORS:
            if integer_of(scene, MATERIAL_IS_MIRROR, material):
                return (0.0, 0.0, 0.0)
        """),
)
def mirrors_take_no_light() -> None:
    """A surface with a mirror's term gets no light of its own: either it mirrors or it is shaded."""


@fault(
    "TREE-2",
    "radiance_at",
    "How many reflections does a ray make for a depth of 1?",
    Edit("integer_of(scene, MAX_DEPTH, 0)", "integer_of(scene, MAX_DEPTH, 0) - 1"),
)
def one_bounce_too_few() -> None:
    """The camera ray counts as the first bounce, so the last reflection is missing."""


@fault(
    "TREE-2",
    "radiance_at",
    "How many reflections does a ray make for a depth of 0?",
    Edit("integer_of(scene, MAX_DEPTH, 0)", "integer_of(scene, MAX_DEPTH, 0) + 1"),
)
def one_bounce_too_many() -> None:
    """The depth is compared with `<=`, so there is one reflection more than allowed."""


@fault("TREE-2", "transmitted_ray", "Which bounces count toward the depth?", Edit("depth - 1", "depth"))
def refractions_not_counted() -> None:
    """Only reflections count toward the depth, refractions do not."""


@fault("TREE-2", "reflected_ray", "When does a path between two mirrors end?", Edit("depth - 1", "depth"))
def no_depth_limit() -> None:
    """The depth is never decreased, so a path between two mirrors has no end."""


@fault(
    "TREE-3",
    "reflected_ray",
    "What do many small contributions add up to?",
    at_the_start("""
        if weight[0] < 0.01 and weight[1] < 0.01 and weight[2] < 0.01:
            weight = (0.0, 0.0, 0.0)
        """),
)
def faint_reflections_left_out() -> None:
    """Reflections that weigh less than one percent are left out to save time."""


@fault(
    "TREE-3",
    "split",
    "How many rays go on from a glass surface?",
    Edit(
        "return reflectance, vector_of(scene, MATERIAL_TRANSMITTANCE, material)",
        """
        transmittance = vector_of(scene, MATERIAL_TRANSMITTANCE, material)
        if reflectance[0] > transmittance[0]:
            return reflectance, (0.0, 0.0, 0.0)
        return (0.0, 0.0, 0.0), transmittance
        """,
    ),
    before(
        "return (reflected, reflected, reflected), (transmitted, transmitted, transmitted)",
        """
        if reflected > transmitted:
            transmitted = 0.0
        else:
            reflected = 0.0
        """,
    ),
)
def only_the_stronger_of_two_rays() -> None:
    """Of the reflected and the transmitted ray only the stronger one is followed."""


@fault(
    "TREE-2",
    "radiance",
    "What does a path bring that may not go on?",
    Edit("depth", "depth + 1"),
    Edit(
        "total = add(total, trace_ray(scene, waiting.pop(), waiting))",
        """
        ray = waiting.pop()
        if ray[5] > 0:
            total = add(total, trace_ray(scene, ray, waiting))
        else:
            total = add(total, multiply(ray[2], background_radiance(scene, ray[1])))
        """,
    ),
)
def background_where_paths_end() -> None:
    """A path whose depth is used up brings the background in place of black."""
