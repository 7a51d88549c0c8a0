from __future__ import annotations

from math import tan
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.noise.splat_bound import has_splat_bound, largest_splats
from raytruth.comparisons.records.renderings import Rays
from raytruth.comparisons.renderers.mitsuba import adapter
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.library import open_scene
from tests.reference_tracer.small_scenes import library_scene
from tests.scenes.exporter_scenes import GLASS, MIRROR, PLANE, POINT, build

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("VER-6")


@pytest.mark.parametrize(
    ("changes", "known"),
    [
        ({"lights": [POINT]}, True),
        ({"lights": [POINT, POINT]}, True),
        ({}, False),
        ({"lights": [POINT], "objects": [PLANE]}, False),
        ({"lights": [POINT], "background": {"color": (0.1, 0.1, 0.1)}}, False),
        ({"lights": [POINT], "materials": {"m": MIRROR}}, False),
        ({"lights": [POINT], "materials": {"m": GLASS}}, False),
        ({"lights": [POINT | {"falloff": "none"}]}, False),
    ],
)
def test_only_point_lights_on_diffuse_surfaces_have_a_bound(changes: dict[str, Any], known: bool) -> None:
    assert has_splat_bound(build(**changes)) == known
    assert not has_splat_bound(open_scene("parallel-projection"))
    assert not has_splat_bound(open_scene("directional-light"))


def test_a_triangle_seen_straight_on_has_the_splat_of_the_formula() -> None:
    base = open_scene("single-triangle")
    light = base.lights[0].model_dump() | {"intensity": (1.0, 2.0, 3.0)}
    camera = {"projection": "perspective", "position": (0, 0, 5), "look_at": (0, 0, 0), "width": 5, "height": 5}
    scene = base.model_validate(
        base.model_dump()
        | {
            "camera": camera | {"vertical_field_of_view": 60.0},
            "lights": [light, light | {"intensity": (0.5, 9.0, 0.0)}],
            "materials": {"m": {"diffuse": {"reflectance": (0.5, 0.25, 1.0)}}},
            "objects": [{"shape": "triangle", "vertices": ((-9, -9, 0), (9, -9, 0), (0, 99, 0)), "material": "m"}],
        }
    )
    splats = largest_splats(scene)
    # On a plane at distance z before the camera, cos θ_s/(d²·cos³ θ) = 1/z² everywhere. Two lights count twice.
    area = (2 * tan(np.pi / 6) / 5) ** 2
    expected = 4 * 2 * np.array([1.0, 9.0, 3.0]) * [0.5, 0.25, 1.0] / (25 * area)
    np.testing.assert_allclose(splats[1:4, 1:4], np.broadcast_to(expected, (3, 3, 3)), rtol=1e-12)


@pytest.mark.parametrize("name", ["sphere-over-floor", "two-lights", "checkerboard-floor", "cornell-box"])
def test_single_splats_of_mitsuba_stay_below_the_bound_and_come_near_it(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(adapter.LIGHT_PATHS, "scalar_rgb", 1)  # one for each pixel and batch
    scene = library_scene(name, 32, 24)
    rendering = adapter.mitsuba_scalar().render(scene, "ptracer", 0, Rays(*primary_rays(scene)), tmp_path)
    assert rendering.batch_means is not None
    bound = largest_splats(scene)
    shares = np.where(bound > 0, rendering.batch_means * 32 * 24 / np.where(bound > 0, bound, 1), 0.0)
    assert not rendering.batch_means[:, bound == 0].any()
    seen = np.sort(shares[shares > 0])
    # With one path for each pixel and batch most pixels are hit once or never: these lie below the bound, as far as
    # float32 can tell, and a tenth of them above its half.
    single = seen[seen <= 1.0 + 1e-5]
    assert len(single) > 0.5 * len(seen)
    assert np.quantile(single, 0.9) > 0.5  # where a bound of twice the size would not
