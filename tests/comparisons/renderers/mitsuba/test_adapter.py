"""Mitsuba itself, end to end, on scenes whose images are known in closed form."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.processes.isolation import LOG_FILE
from raytruth.comparisons.records.renderings import Rays, RendererError, Rendering
from raytruth.comparisons.renderers.mitsuba import adapter
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_llvm, mitsuba_scalar
from raytruth.comparisons.renderers.mitsuba.job import RESULT_FILE
from raytruth.scenes.exporters import mitsuba as exporter
from tests.comparisons.renderers.sphere_scenes import (
    HEIGHT,
    LIGHTS,
    LOOK_AT,
    WIDTH,
    build,
    diffuse_sphere,
    point_light,
    primary_rays,
    sphere_depth,
    unit,
)

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-4")

# design.md asks for this on deterministic scenes with diffuse surfaces and single lights.
DIFFUSE_BOUND = 2e-5


# Set where every reference must be there (.ci/run): a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Scalar Mitsuba is a dependency and must run; its LLVM variant is tested where this machine has an LLVM for it."""
    if "renderer" in metafunc.fixturenames:
        optional = (mitsuba_llvm(),)
        renderers = [mitsuba_scalar(), *(renderer for renderer in optional if REQUIRE_ALL or renderer.version())]
        metafunc.parametrize("renderer", renderers, ids=[renderer.name for renderer in renderers])


def render(
    renderer: Renderer, scene: Scene, folder: Path, *, depth: int, integrator: str = "path"
) -> tuple[Rendering, Rays]:
    rays = primary_rays(scene.camera.projection)
    return renderer.render(scene, integrator, depth, rays, folder), rays


@pytest.mark.parametrize(("projection", "integrator"), [("perspective", "direct"), ("orthographic", "path")])
def test_a_diffuse_sphere_is_the_closed_form_and_two_lights_add_up(
    renderer: Renderer, projection: str, integrator: str, tmp_path: Path
) -> None:
    scene = build(projection, lights=[point_light(LIGHTS[0], 9.0), point_light(LIGHTS[1], 5.0)])
    rendering, rays = render(renderer, scene, tmp_path, depth=1, integrator=integrator)
    expected = diffuse_sphere(rays, LIGHTS[0], 9.0) + diffuse_sphere(rays, LIGHTS[1], 5.0)
    assert expected.max() > 0.1
    assert np.abs(rendering.image - expected).max() < DIFFUSE_BOUND
    assert rendering.image.dtype == np.float32
    assert rendering.samples == 1
    assert rendering.seconds > 0
    kept = {path.name for path in tmp_path.iterdir()}
    assert {LOG_FILE, "scene-0.xml", "scene-1.xml"} <= kept
    assert not any(name.startswith("unfinished") for name in kept)


def test_light_traced_forward_gives_the_mean_of_the_closed_form_with_independent_batches(
    renderer: Renderer, tmp_path: Path
) -> None:
    scene = build(lights=[point_light(LIGHTS[0], 9.0), point_light(LIGHTS[1], 5.0)])
    assert renderer.is_stochastic(scene, "ptracer")
    rendering, rays = render(renderer, scene, tmp_path, depth=0, integrator="ptracer")
    means = rendering.batch_means
    assert means is not None
    assert len(means) == adapter.LIGHT_PATH_BATCHES
    assert rendering.samples >= adapter.LIGHT_PATHS["scalar_rgb"] * 0.99
    assert rendering.samples % (adapter.LIGHT_PATH_BATCHES * WIDTH * HEIGHT) == 0
    assert rendering.image is not None
    assert np.abs(means.mean(axis=0, dtype=np.float64) - rendering.image).max() < 1e-6
    inner = sphere_depth(rays, LOOK_AT, 1.1) < np.inf  # away from the rim, where the mean is nearly that at the centre
    expected = (diffuse_sphere(rays, LIGHTS[0], 9.0) + diffuse_sphere(rays, LIGHTS[1], 5.0))[inner].mean()
    of_batches = means[:, inner].mean(axis=(1, 2), dtype=np.float64)
    assert len(np.unique(of_batches)) == len(of_batches)
    error = of_batches.std(ddof=1) / np.sqrt(len(of_batches))
    # Six deviations, and half a percent for the means over pixels of a twentieth of the sphere's size.
    assert abs(of_batches.mean() - expected) < 6 * error + 0.005 * expected


@pytest.mark.parametrize("near_clip", [1e-9, 1e-2, 1.0])
def test_first_hits_do_not_depend_on_the_near_plane(
    near_clip: float, renderer: Renderer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Mitsuba starts its own camera's rays on that plane, and its depths there: the adapter's rays start at the camera.
    monkeypatch.setattr(exporter, "NEAR_CLIP", near_clip)
    rendering, rays = render(renderer, build(lights=[point_light(LIGHTS[0], 9.0)]), tmp_path, depth=1)
    assert f'name="near_clip" value="{near_clip!r}"' in (tmp_path / exporter.SCENE_FILE).read_text()
    hits = rendering.first_hits
    assert hits is not None
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    inner = sphere_depth(rays, LOOK_AT, 1.1) < np.inf
    # Distances up to 6 in float32; the cosine is above 0.4 there. A plane at 1e-2 would shift them by 1e-2.
    assert np.abs(hits.depth[inner] - depth[inner]).max() < 64 * 2.0**-24 * 6 / 0.4


def test_an_unfit_llvm_ends_the_trial_alone_and_the_renderer_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DRJIT_LIBLLVM_PATH", "/nowhere/libLLVM.so")  # as one that aborts: the trial's process fails
    adapter._try_variant.cache_clear()
    assert mitsuba_llvm().version() is None
    assert mitsuba_scalar().version() is not None
    adapter._try_variant.cache_clear()
    assert "apt install libllvm" in mitsuba_llvm().install


def test_a_directional_light_gives_its_irradiance(tmp_path: Path) -> None:
    direction = np.array([-0.4, -1.0, -0.7])
    light = {"kind": "directional", "direction": tuple(direction), "irradiance": (2.0, 3.0, 4.0)}
    rendering, rays = render(mitsuba_scalar(), build(lights=[light]), tmp_path, depth=1)
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    with np.errstate(invalid="ignore"):
        normals = unit(rays.origins + depth[..., None] * rays.directions - LOOK_AT)
        cosine = np.where(np.isfinite(depth), np.maximum(0, normals @ -unit(direction)), 0)
    assert np.abs(rendering.image - cosine[..., None] * [1.6, 0.9, 0.4] / np.pi).max() < DIFFUSE_BOUND


def test_a_mirror_sphere_shows_the_gradient_behind_the_camera_and_a_miss_the_one_ahead(
    renderer: Renderer, tmp_path: Path
) -> None:
    bottom, top, reflectance = np.array([0.3, 0.2, 0.1]), np.array([0.1, 0.2, 0.9]), np.array([0.9, 0.8, 0.7])
    scene = build(
        materials={"red": {"mirror": {"reflectance": tuple(reflectance)}}},
        background={"bottom": tuple(bottom), "top": tuple(top)},
    )
    rendering, rays = render(renderer, scene, tmp_path, depth=1)
    depth = sphere_depth(rays, LOOK_AT, 1.2)
    with np.errstate(invalid="ignore"):
        normals = unit(rays.origins + depth[..., None] * rays.directions - LOOK_AT)
        mirrored = rays.directions - 2 * np.sum(rays.directions * normals, axis=-1, keepdims=True) * normals
    hit = np.isfinite(depth)[..., None]
    height = np.where(hit, mirrored, rays.directions)[..., 1:2]
    expected = np.where(hit, reflectance, 1.0) * ((top + bottom) / 2 + height * (top - bottom) / 2)
    assert np.abs(rendering.image - expected).max() < DIFFUSE_BOUND


def test_with_no_vertex_before_the_light_a_mirror_is_black(tmp_path: Path) -> None:
    materials = {"red": {"mirror": {"reflectance": (1.0, 1.0, 1.0)}}}
    scene = build(materials=materials, background={"color": (0.1, 0.2, 0.3)})
    rendering, rays = render(mitsuba_scalar(), scene, tmp_path, depth=0)
    hit = np.isfinite(sphere_depth(rays, LOOK_AT, 1.2))
    assert not rendering.image[hit].any()
    assert np.array_equal(np.unique(rendering.image[~hit], axis=0), np.array([[0.1, 0.2, 0.3]], dtype=np.float32))


def test_an_emissive_checkerboard_shines_on_both_sides_and_keeps_its_normals(
    renderer: Renderer, tmp_path: Path
) -> None:
    corners = [(-9.0, -0.3, -9.0), (-9.0, -0.3, 9.0), (9.0, -0.3, 9.0), (9.0, -0.3, -9.0)]
    board = {"even": (2.0, 3.0, 4.0), "odd": (0.1, 0.2, 0.0), "size": 0.37, "plane": "xz", "offset": (0.11, -0.23)}
    floor = {"shape": "mesh", "vertices": corners, "faces": ((0, 1, 2), (0, 3, 2)), "material": "lamp"}
    scene = build(materials={"lamp": {"emission": {"radiance": {"checkerboard": board}}}}, objects=[floor])
    rendering, rays = render(renderer, scene, tmp_path, depth=0)
    hits = rendering.first_hits
    assert hits is not None
    assert set(np.unique(hits.primitive)) >= {0, 1}
    inside = hits.primitive >= 0
    depth = (-0.3 - rays.origins[..., 1]) / rays.directions[..., 1]
    squares = ((rays.origins + depth[..., None] * rays.directions)[..., [0, 2]] - [0.11, -0.23]) / 0.37
    # Coordinates up to 9 in float32, over squares of 0.37: borders move by less than this many squares.
    certain = inside & (np.abs(squares - np.round(squares)).min(axis=-1) > 1e-4)
    assert certain.sum() > 0.9 * inside.sum()
    even = (np.floor(squares).sum(axis=-1) % 2 == 0)[..., None]
    expected = np.where(even, [2.0, 3.0, 4.0], [0.1, 0.2, 0.0]).astype(np.float32)
    assert np.array_equal(rendering.image[certain], expected[certain])
    for face, side in ((0, 1.0), (1, -1.0)):
        assert np.abs(hits.normal[hits.primitive == face] - [0.0, side, 0.0]).max() < 1e-6


def test_a_diffuse_checkerboard_is_shaded_by_its_own_squares(tmp_path: Path) -> None:
    even, odd = (0.9, 0.5, 0.1), (0.2, 0.3, 0.8)
    board = {"even": even, "odd": odd, "size": 0.6}
    corners = ((-6.0, -0.5, -6.0), (-6.0, -0.5, 6.0), (6.0, -0.5, 6.0), (6.0, -0.5, -6.0))
    wall = {"shape": "mesh", "vertices": corners, "faces": ((0, 1, 2), (0, 2, 3)), "material": "wall"}
    materials = {"wall": {"diffuse": {"reflectance": {"checkerboard": board}}}}
    scene = build(materials=materials, objects=[wall], lights=[point_light(LIGHTS[0], 9.0)])
    rendering, rays = render(mitsuba_scalar(), scene, tmp_path, depth=1, integrator="direct")
    depth = (-0.5 - rays.origins[..., 1]) / rays.directions[..., 1]
    points = rays.origins + depth[..., None] * rays.directions
    squares = points[..., [0, 2]] / 0.6
    certain = (np.abs(points[..., [0, 2]]).max(axis=-1) < 5.99) & (depth > 0)
    certain &= np.abs(squares - np.round(squares)).min(axis=-1) > 1e-4
    assert certain.sum() > WIDTH * HEIGHT / 2
    to_light = LIGHTS[0] - points
    irradiance = 9.0 * to_light[..., 1] / np.sum(to_light**2, axis=-1) ** 1.5
    colors = np.where((np.floor(squares).sum(axis=-1) % 2 == 0)[..., None], even, odd)
    expected = colors * irradiance[..., None] / np.pi
    assert np.abs(rendering.image - expected)[certain].max() < DIFFUSE_BOUND


def test_first_hits_are_those_of_the_very_same_rays(renderer: Renderer, tmp_path: Path) -> None:
    """Rays that no camera sends: towards one of two spheres, in the scene's order after a triangle."""
    triangle = {"shape": "triangle", "vertices": ((-9.0, -9.0, -3.0), (9.0, -9.0, -3.0), (0.0, 12.0, -3.0))}
    centers, radii = np.array([[0.2, -0.1, 0.3], [1.7, 0.4, -0.8]]), (1.2, 0.7)
    spheres = [
        {"shape": "sphere", "center": tuple(center), "radius": radius, "material": "red"}
        for center, radius in zip(centers.tolist(), radii, strict=True)
    ]
    scene = build(objects=[triangle | {"material": "red"}, *spheres])
    random = np.random.default_rng(7)
    origins = random.uniform(3.0, 6.0, (HEIGHT, WIDTH, 3))
    rays = Rays(origins, unit(random.uniform(-1.5, 2.5, origins.shape) - origins))
    rendering = renderer.render(scene, "first-hits", 0, rays, tmp_path)
    hits = rendering.first_hits
    assert rendering.image is None
    assert hits is not None
    beside_image = renderer.render(scene, "direct", 1, rays, tmp_path).first_hits
    for name, values in vars(hits).items():
        np.testing.assert_array_equal(values, vars(beside_image)[name])
    depths = [sphere_depth(rays, center, radius) for center, radius in zip(centers, radii, strict=True)]
    plane = (-3.0 - origins[..., 2]) / rays.directions[..., 2]
    nearest = np.minimum(*depths)
    on_sphere = np.isfinite(nearest)
    assert set(np.unique(hits.primitive)) == {-1, 0, 1, 2}
    # A ray that passes a sphere at a distance of about float32's resolution may be decided either way.
    assert np.sum((hits.primitive == 0) | (hits.primitive == 1)) == on_sphere.sum()
    assert np.array_equal(hits.primitive[on_sphere], np.argmin(depths, axis=0)[on_sphere])
    assert np.isinf(hits.depth[hits.primitive == -1]).all()
    for index, center in enumerate(centers):
        at = hits.primitive == index
        cosine = np.abs(np.sum(hits.normal[at] * rays.directions[at], axis=-1))
        # Distances up to 9 in float32, and a grazing ray moves its hit by the inverse of the cosine.
        bound = 64 * 2.0**-24 * 9 / cosine
        assert (np.abs(hits.depth[at] - nearest[at]) < bound).all()
        points = origins[at] + nearest[at][:, None] * rays.directions[at]
        assert (np.linalg.norm(hits.position[at] - points, axis=-1) < bound).all()
        assert (np.linalg.norm(hits.normal[at] - unit(points - center), axis=-1) < bound / radii[index]).all()
    at = hits.primitive == 2
    assert np.abs(hits.depth[at] / plane[at] - 1).max() < 64 * 2.0**-24
    assert np.abs(hits.normal[at] - [0.0, 0.0, 1.0]).max() < 1e-6


def test_the_mean_over_a_glass_slab_is_the_known_one_and_batches_and_pixels_are_independent(
    renderer: Renderer, tmp_path: Path
) -> None:
    """Straight on, a slab of index n reflects R = 2r/(1+r), r = ((n-1)/(n+1))², all orders of reflection summed."""
    index = 1.9
    r = ((index - 1) / (index + 1)) ** 2
    reflected = 2 * r / (1 + r)
    corners = np.array([[-60.0, -60.0], [60.0, -60.0], [0.0, 90.0]])
    back, front = (np.column_stack([corners, np.full(3, z)]).tolist() for z in (-1.0, 0.0))
    slab = [{"shape": "triangle", "vertices": v, "material": "glass"} for v in (front, back[::-1])]
    lamp = {"shape": "sphere", "center": (0.0, 0.0, -80.0), "radius": 20.0, "material": "far"}
    scene = build(
        materials={
            "glass": {"dielectric": {"index_of_refraction": index}},
            "far": {"emission": {"radiance": (1.0, 0.0, 0.25)}},
        },
        objects=[*slab, lamp],
    )
    assert renderer.is_stochastic(scene, "path")
    random = np.random.default_rng(3)
    origins = np.concatenate([random.uniform(-1.0, 1.0, (HEIGHT, WIDTH, 2)), np.full((HEIGHT, WIDTH, 1), 4.0)], axis=-1)
    rays = Rays(origins, np.broadcast_to([0.0, 0.0, -1.0], origins.shape))
    rendering = renderer.render(scene, "path", 40, rays, tmp_path)  # r^40 is nothing
    means = rendering.batch_means
    assert means is not None
    assert means.shape == (adapter.BATCHES, HEIGHT, WIDTH, 3)
    assert rendering.samples >= 8 * adapter.BATCHES
    assert np.abs(means.mean(axis=0, dtype=np.float64) - rendering.image).max() < 1e-6

    # Hoeffding 1963, theorem 2: P(|mean - truth| >= t) <= 2·exp(-2·N·t²) for samples in [0, 1].
    count = rendering.samples * WIDTH * HEIGHT
    bound = np.sqrt(np.log(2 / 1e-6) / (2 * count))
    overall = rendering.image.mean(axis=(0, 1), dtype=np.float64)
    assert abs(overall[0] - (1 - reflected)) < bound
    assert np.array_equal(rendering.image[..., 2], rendering.image[..., 0] / 4)
    assert not rendering.image[..., 1].any()

    # Were pixels or batches to share random numbers, the variance of the overall mean of a batch would exceed p·q/N.
    variance = reflected * (1 - reflected) / (rendering.samples / adapter.BATCHES * WIDTH * HEIGHT)
    batch_errors = means[..., 0].mean(axis=(1, 2), dtype=np.float64) - (1 - reflected)
    chi_squared = np.sum(batch_errors**2) / variance
    # The quantiles 1e-6 and 1 - 1e-6 of chi-squared with 128 degrees of freedom.
    assert adapter.BATCHES == 128
    assert 65.8 < chi_squared < 218.9


def test_a_crash_of_the_worker_is_one_sentence_and_its_log_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = adapter.MitsubaRenderer("broken", "no_such_variant", adapter.BY_CAMERA_RAYS, "")
    monkeypatch.setitem(adapter.BATCH_SAMPLES, "no_such_variant", 1)
    with pytest.raises(RendererError, match=r"exit status 1; its log ends: .*no_such_variant") as raised:
        render(broken, build(), tmp_path, depth=1)
    assert "\n" not in str(raised.value)
    assert "no_such_variant" in (tmp_path / LOG_FILE).read_text()
    assert broken.version() is None


def test_a_worker_that_writes_nothing_is_an_error_even_over_an_old_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / RESULT_FILE).write_bytes(b"old")
    monkeypatch.setattr(adapter, "run_isolated", lambda *_, **__: None)
    with pytest.raises(RendererError, match=r"result\.npz cannot be read"):
        render(mitsuba_scalar(), build(), tmp_path, depth=1)


def test_the_parent_process_never_loads_mitsuba() -> None:
    assert mitsuba_scalar().version() is not None
    assert "mitsuba" not in sys.modules
