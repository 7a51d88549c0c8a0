"""Who has no infinite planes refuses them before it looks at any shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.bare_geometry import bare_geometry
from raytruth.scenes.extent import extent_of, spans_of
from raytruth.scenes.features import Feature
from raytruth.scenes.planes import has_planes, refuses_planes
from raytruth.scenes.requirements import required_features
from tests.scenes.exporter_scenes import BALL, FLOOR, PLANE, POINT, build

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

WITH_PLANE = build(objects=[PLANE, FLOOR], lights=[POINT])
WITHOUT = build(objects=[BALL, FLOOR], lights=[POINT])
HAVE_PLANES = {"povray", "closed_form", "raytruth"}


@pytest.mark.clause("REN-3")
def test_a_scene_with_a_plane_is_refused_by_name_and_one_without_is_not() -> None:
    assert has_planes(WITH_PLANE)
    assert not has_planes(WITHOUT)
    assert refuses_planes("Nobody", WITHOUT) is None
    assert str(refuses_planes("Nobody", WITH_PLANE)).startswith("Nobody has no infinite planes, and ")


@pytest.mark.clause("REN-3", "VER-8")
@pytest.mark.parametrize("name", sorted(all_renderers().keys() - HAVE_PLANES))
@pytest.mark.parametrize("scene", [WITH_PLANE, bare_geometry(WITH_PLANE), build(objects=[PLANE])])
def test_a_reference_without_planes_says_so(name: str, scene: Scene) -> None:
    assert "has no infinite planes" in str(all_renderers()[name].refuses(scene))


@pytest.mark.clause("SCN-6")
def test_a_scenes_bare_geometry_keeps_its_planes() -> None:
    assert Feature.PLANES in required_features(bare_geometry(WITH_PLANE))


@pytest.mark.clause("REN-4")
def test_of_a_plane_its_point_alone_counts_for_the_extent() -> None:
    centers, radii = spans_of(build(objects=[BALL, PLANE]))
    assert centers.tolist() == [list(BALL["center"]), list(PLANE["point"])]
    assert radii.tolist() == [BALL["radius"], 0.0]
    assert extent_of(build(objects=[BALL, PLANE | {"point": (1e6, 0.0, 0.0)}])) > 4e6
