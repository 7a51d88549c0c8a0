from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT32, FLOAT64
from raytruth.reference_tracer.numbering import objects_of_primitives
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.tables import build_tables, material_number, triangles_of
from raytruth.scenes.features import Feature
from raytruth.scenes.requirements import required_features
from tests.reference_tracer.small_scenes import lamp, plane, small_scene, sphere, square

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("SCN-6")


def tables_of(scene: Scene) -> layout.SceneData:
    return build_tables(scene, required_features(scene), FLOAT)


def mixed_scene() -> Scene:
    return small_scene(
        materials={
            "glass": {"dielectric": {"index_of_refraction": 1.5, "outside": "water"}},
            "water": {"dielectric": {"index_of_refraction": 1.25}},
            "white": {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}},
        },
        objects=[square("white", -3.0), sphere("glass"), sphere("white", (5.0, 0.0, 0.0), 2.0)],
        lights=[lamp((0.0, 0.0, 3.0)), lamp((0.0, 0.0, 4.0), 2.0, {"constant": 1.0, "linear": 2.0, "quadratic": 3.0})],
        max_depth=3,
    )


@pytest.mark.clause("TRAV-2")
def test_spheres_and_triangles_keep_their_order() -> None:
    data = tables_of(mixed_scene())
    assert layout.vector_of(data, layout.SPHERE_CENTER, 1) == (5.0, 0.0, 0.0)
    assert [layout.number_of(data, layout.SPHERE_RADIUS, row) for row in range(2)] == [1.0, 2.0]
    assert [layout.integer_of(data, layout.SPHERE_MATERIAL, row) for row in range(2)] == [0, 2]
    assert layout.rows_of(data, layout.TRIANGLE_MATERIAL) == 2
    assert layout.vector_of(data, layout.TRIANGLE_B, 0) == (100.0, -100.0, -3.0)
    corners, materials = triangles_of(mixed_scene())
    assert corners.shape == (2, 3, 3)
    assert materials == ["white", "white"]


@pytest.mark.clause("TRAV-2")
def test_planes_come_last_wherever_the_scene_states_them() -> None:
    scene = mixed_scene()
    objects = [plane("white", -7.0, -2.0), *mixed_scene().model_dump()["objects"], plane("glass", -9.0, 0.5)]
    with_planes = type(scene).model_validate(scene.model_dump(exclude={"name"}) | {"objects": objects})
    data = tables_of(with_planes)
    assert layout.first_plane(data) == 4
    assert [layout.plane_of(data, primitive) for primitive in (-1, 0, 3, 4, 5)] == [-5, -4, -1, 0, 1]
    assert [layout.vector_of(data, layout.PLANE_POINT, row)[2] for row in range(2)] == [-7.0, -9.0]
    assert [layout.vector_of(data, layout.PLANE_NORMAL, row) for row in range(2)] == [(0, 0, -2), (0, 0, 0.5)]
    assert [layout.integer_of(data, layout.PLANE_MATERIAL, row) for row in range(2)] == [2, 0]
    assert triangles_of(with_planes)[1] == ["white", "white"]
    assert objects_of_primitives(with_planes) == [2, 3, 1, 1, 0, 4]


@pytest.mark.clause("REFR-1")
def test_media_know_what_is_outside_of_them() -> None:
    data = tables_of(mixed_scene())
    assert [layout.integer_of(data, layout.MATERIAL_OUTSIDE, row) for row in range(3)] == [1, -1, -1]
    assert [layout.number_of(data, layout.MATERIAL_INDEX, row) for row in range(2)] == [1.5, 1.25]
    assert [layout.number_of(data, layout.MATERIAL_OUTSIDE_INDEX, row) for row in range(2)] == [1.25, 1.0]
    assert material_number(mixed_scene(), "water") == 1
    assert material_number(mixed_scene(), None) == -1


@pytest.mark.clause("ILL-7")
def test_each_light_has_its_falloff() -> None:
    data = tables_of(mixed_scene())
    assert [layout.integer_of(data, layout.LIGHT_FALLOFF, row) for row in range(2)] == [0, 2]
    assert layout.vector_of(data, layout.LIGHT_FALLOFF_COEFFICIENTS, 1) == (1.0, 2.0, 3.0)


@pytest.mark.clause("ILL-7")
def test_each_kind_of_falloff_has_a_number_of_its_own() -> None:
    # Literally: the tables take the numbers from the tracer, so that to compare the two would compare nothing.
    falloffs = ["none", "inverse_square", {"constant": 1.0, "linear": 2.0, "quadratic": 3.0}]
    data = tables_of(small_scene(lights=[lamp((0.0, 0.0, 3.0), falloff=falloff) for falloff in falloffs]))
    assert [layout.integer_of(data, layout.LIGHT_FALLOFF, row) for row in range(3)] == [0, 1, 2]


def test_only_what_the_scene_requires_is_stored() -> None:
    data = tables_of(small_scene(lights=[lamp((0.0, 0.0, 3.0))]))
    absent = [
        name
        for name in vars(layout)
        if name.startswith(("TRIANGLE_", "PLANE_", "NODE_", "CHECKERBOARD_", "SUN_", "AMBIENT_", "BACKGROUND_"))
        or (name.startswith("MATERIAL_") and not name.startswith(("MATERIAL_IS_LIT", "MATERIAL_DIFFUSE")))
    ]
    assert len(absent) > 30
    assert all(layout.rows_of(data, getattr(layout, name)) == 0 for name in absent)


def test_many_triangles_get_a_tree_and_few_do_not() -> None:
    assert layout.rows_of(tables_of(mixed_scene()), layout.NODE_END) == 0
    many = small_scene(objects=[square("white", -float(z)) for z in range(20)])
    assert Feature.BOUNDING_VOLUMES in required_features(many)
    assert layout.rows_of(tables_of(many), layout.NODE_ORDER) == 40


@pytest.mark.clause("ARI-1")
def test_numbers_are_of_the_kernels_type() -> None:
    for arithmetic, number_type in ((FLOAT64, np.float64), (FLOAT32, np.float32)):
        data = build_tables(mixed_scene(), required_features(mixed_scene()), arithmetic)
        assert data.numbers.dtype == number_type
        assert data.numbers.flags.c_contiguous
        assert data.integers.dtype == np.int64
