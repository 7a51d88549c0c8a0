from __future__ import annotations

from math import inf

import pytest

from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.traversal import (
    NOTHING,
    distance_to_plane,
    distance_to_sphere,
    distance_to_triangle,
    is_occluded,
    material_of,
    nearest_hit,
    surface_normal,
)
from tests.reference_tracer.kernels import scene_data

AHEAD = (0.0, 0.0, -1.0)
# Two spheres on the z axis, then two triangles across it: primitives 0 to 3.
TABLES = {
    layout.SPHERE_CENTER: [(0.0, 0.0, 0.0), (0.0, 0.0, -4.0)],
    layout.SPHERE_RADIUS: [1.0, 1.0],
    layout.SPHERE_MATERIAL: [7, 5],
    layout.TRIANGLE_A: [(-9.0, -9.0, -2.0), (-9.0, -9.0, 3.0)],
    layout.TRIANGLE_B: [(9.0, -9.0, -2.0), (0.0, 9.0, 3.0)],
    layout.TRIANGLE_C: [(0.0, 9.0, -2.0), (9.0, -9.0, 3.0)],
    layout.NODE_LOW: [(-9.0, -9.0, -2.0)],
    layout.NODE_HIGH: [(9.0, 9.0, 3.0)],
    layout.NODE_END: [1],
    layout.NODE_FIRST_TRIANGLE: [0],
    layout.NODE_TRIANGLES: [2],
    layout.NODE_ORDER: [1, 0],
    # Not behind the spheres' materials, so that none of these is taken for one of them and is right by chance.
    layout.TRIANGLE_MATERIAL: [2, 3],
}
SCENE = scene_data(TABLES)


# The same, and two planes across the z axis, one of which coincides with triangle 3: primitives 4 and 5.
WITH_PLANES = {
    layout.PLANE_POINT: [(5.0, -5.0, 2.0), (-7.0, 3.0, 3.0)],
    layout.PLANE_NORMAL: [(0.0, 0.0, -4.0), (0.0, 0.0, 0.5)],
    layout.CAMERA_SIZE: [6, 6],  # so that no material is that of the neighbouring table by chance
    layout.PLANE_MATERIAL: [8, 9],
}
PLANES = scene_data(TABLES | WITH_PLANES)


@pytest.mark.clause("TRAV-1")
@pytest.mark.parametrize(
    ("z", "left", "expected"),
    [
        (9.0, NOTHING, (6.0, 3)),
        (3.0, 3, (2.0, 0)),  # a triangle that the ray has left is not met again
        (1.0, 0, (2.0, 0)),  # of a sphere that the ray has left the other side remains
        (-1.0, 0, (1.0, 2)),  # and nothing of it for a ray that leaves outward
        (-2.0, 2, (1.0, 1)),
        (-5.0, 1, (inf, -1)),  # as it is told to users
    ],
)
def test_the_nearest_primitive_is_hit(z: float, left: int, expected: tuple[float, int]) -> None:
    assert nearest_hit(SCENE, (0.0, 0.0, z), AHEAD, left) == expected


@pytest.mark.clause("SPH-4", "TRI-3")
def test_what_was_left_is_left_out_by_its_number_not_by_a_distance() -> None:
    # A point that rounding has moved by a thousandth: still nothing but the other side.
    assert distance_to_sphere(SCENE, (0.0, 0.0, 1.001), AHEAD, 0, 0) == 2.002
    assert distance_to_triangle(SCENE, (0.0, 0.0, 3.001), AHEAD, 1, 1) == inf
    assert distance_to_triangle(SCENE, (0.0, 0.0, 3.5), AHEAD, 0, 1) == 0.5


@pytest.mark.clause("SHAD-1")
@pytest.mark.parametrize(("end", "occluded"), [(5.9, False), (6.0, False), (6.1, True), (inf, True)])
def test_only_what_is_nearer_than_the_end_occludes(end: float, occluded: bool) -> None:
    assert is_occluded(SCENE, (0.0, 0.0, 9.0), AHEAD, NOTHING, end) == occluded


@pytest.mark.clause("TRAV-3")
def test_of_two_at_the_same_distance_the_first_is_hit() -> None:
    twins = scene_data(
        {
            layout.SPHERE_CENTER: [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)],
            layout.SPHERE_RADIUS: [1.0, 1.0],
            layout.SPHERE_MATERIAL: [0, 0],
        }
    )
    assert nearest_hit(twins, (0.0, 0.0, 3.0), AHEAD, NOTHING) == (2.0, 0)


@pytest.mark.clause("TRAV-2")
@pytest.mark.parametrize(
    ("primitive", "material", "normal"),
    [(0, 7, (0.0, 0.0, 1.0)), (2, 2, (0.0, 0.0, 1.0)), (3, 3, (0.0, 0.0, -1.0))],
)
def test_materials_and_normals_belong_to_primitives(
    primitive: int, material: int, normal: tuple[float, float, float]
) -> None:
    assert material_of(SCENE, primitive) == material
    assert surface_normal(SCENE, primitive, (0.0, 0.0, 1.0)) == normal


@pytest.mark.clause("TRAV-1", "TRAV-3", "PLANE-3")
@pytest.mark.parametrize(
    ("z", "left", "expected"),
    [
        (9.0, NOTHING, (6.0, 3)),  # a triangle wins over the plane that it lies in
        (3.0, 3, (1.0, 4)),  # whoever leaves it meets neither: the plane is at t = 0
        (3.0, 5, (1.0, 4)),
        (2.0, 4, (1.0, 0)),  # a plane that the ray has left is not met again
        (2.0, NOTHING, (1.0, 0)),  # nor one that it starts on
    ],
)
def test_planes_are_met_as_all_else_is(z: float, left: int, expected: tuple[float, int]) -> None:
    assert nearest_hit(PLANES, (0.0, 0.0, z), AHEAD, left) == expected


@pytest.mark.clause("PLANE-3")
def test_a_plane_that_was_left_is_left_out_by_its_number_not_by_a_distance() -> None:
    assert distance_to_plane(PLANES, (0.0, 0.0, 2.001), AHEAD, 0, 0) == inf
    assert distance_to_plane(PLANES, (0.0, 0.0, 2.5), AHEAD, 1, 0) == 0.5
    # By its number among all primitives: the first plane is the fifth of them.
    assert nearest_hit(PLANES, (0.0, 0.0, 2.001), AHEAD, 4) == (1.001, 0)
    assert nearest_hit(PLANES, (0.0, 0.0, 2.25), AHEAD, 5) == (0.25, 4)
    assert not is_occluded(PLANES, (0.0, 0.0, 2.001), AHEAD, 4, 1.0)
    assert is_occluded(PLANES, (0.0, 0.0, 2.001), AHEAD, 5, 1.0)


@pytest.mark.clause("TRAV-3")
def test_of_two_planes_in_one_place_the_first_is_met() -> None:
    same = {layout.PLANE_POINT: [(5.0, -5.0, 2.0), (-7.0, 3.0, 2.0)]}
    assert nearest_hit(scene_data(WITH_PLANES | same), (0.0, 0.0, 9.0), AHEAD, NOTHING) == (7.0, 0)


@pytest.mark.clause("SHAD-1", "SHAD-3")
@pytest.mark.parametrize(("end", "occluded"), [(0.9, False), (1.0, False), (1.1, True), (inf, True)])
def test_planes_occlude_what_is_behind_them(end: float, occluded: bool) -> None:
    alone = scene_data(WITH_PLANES)
    assert is_occluded(alone, (0.0, 0.0, 4.0), AHEAD, NOTHING, end) == occluded
    assert is_occluded(alone, (0.0, 0.0, 3.0), AHEAD, 1, end) == occluded
    assert not is_occluded(alone, (0.0, 0.0, 2.0), AHEAD, 0, end)


# Tilted, since all triangles face along z: a number taken for one of theirs would give the right normal by chance.
TILTED = scene_data(TABLES | WITH_PLANES | {layout.PLANE_NORMAL: [(3.0, 4.0, 0.0), (0.0, -3.0, 4.0)]})


@pytest.mark.clause("TRAV-2")
@pytest.mark.parametrize(
    ("primitive", "material", "normal"),
    [
        (0, 7, (0.0, 0.0, 1.0)),
        (1, 5, (0.0, 0.0, 5.0)),
        (2, 2, (0.0, 0.0, 1.0)),
        (3, 3, (0.0, 0.0, -1.0)),
        (4, 8, (0.6, 0.8, 0.0)),
        (5, 9, (0.0, -0.6, 0.8)),
    ],
)
def test_planes_are_numbered_after_spheres_and_triangles(
    primitive: int, material: int, normal: tuple[float, float, float]
) -> None:
    assert material_of(TILTED, primitive) == material
    assert surface_normal(TILTED, primitive, (0.0, 0.0, 1.0)) == pytest.approx(normal)
