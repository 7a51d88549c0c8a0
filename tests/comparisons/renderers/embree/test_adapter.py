"""Embree itself, judged by the matrix; what it cannot express is refused; faults in its export are caught."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.verdict import Expectation, expectation_of
from raytruth.comparisons.matrix.cell import run_cell
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.embree import adapter
from raytruth.comparisons.renderers.embree.adapter import embree, embree_robust
from raytruth.comparisons.renderers.embree.job import RESULT_FILE
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.shapes import Plane, Sphere
from tests.comparisons.matrix.cell_places import place_of
from tests.scenes.exporter_scenes import BALL, POINT, RED, build

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell
    from raytruth.comparisons.renderers.protocol import Renderer

pytestmark = pytest.mark.clause("REN-4")

# Set where every reference must be there (.ci/run): a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))
RENDERERS = [embree(), embree_robust()]
needs_embree = pytest.mark.skipif(not REQUIRE_ALL and embree().version() is None, reason="embreex is not installed")
CELLS = [(renderer, integrator.name) for renderer in RENDERERS for integrator in renderer.integrators]

FLOOR = {
    "shape": "mesh",
    "vertices": ((-9.0, -1.1, -9.0), (-9.0, -1.1, 9.0), (9.0, -1.1, 9.0), (9.0, -1.1, -9.0)),
    "faces": ((0, 1, 2), (0, 2, 3)),
    "material": "m",
}
ROOF = {"shape": "triangle", "vertices": ((-0.7, 0.4, 0.3), (0.8, 0.6, 0.1), (0.1, 0.5, -0.9)), "material": "m"}
SUN = {"kind": "directional", "direction": (-0.3, -1.0, 0.2), "irradiance": (1.0, 2.0, 0.5)}


def expectation(renderer: Renderer) -> Expectation:
    scene = build(materials={"m": RED}, objects=[FLOOR, ROOF], lights=[POINT, SUN])
    truth = np.asarray(render(scene, FLOAT), dtype=np.float64)
    return expectation_of(scene, truth, feasible_set(scene, renderer.error_model))


def cell_of(renderer: Renderer, integrator: str, folder: Path) -> Cell:
    by = expectation(renderer)
    return run_cell(place_of(by.scene, renderer, integrator), 0, by, folder)


@needs_embree
@pytest.mark.parametrize(("renderer", "integrator"), CELLS, ids=[f"{r.name}-{i}" for r, i in CELLS])
def test_a_roof_over_a_floor_passes(renderer: Renderer, integrator: str, tmp_path: Path) -> None:
    cell = cell_of(renderer, integrator, tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason
    assert cell.first_hits is not None
    assert (cell.judgement is None) == (integrator == "first-hits")


def shifted(triangles: Any) -> Any:
    return np.add(triangles, (0.0, 1e-4, 0.0))


def renumbered(triangles: Any) -> Any:
    return triangles[::-1]


def turned(triangles: Any) -> Any:
    return triangles[:, ::-1]


@needs_embree
@pytest.mark.parametrize("renderer", RENDERERS, ids=lambda renderer: renderer.name)
@pytest.mark.parametrize("fault", [shifted, renumbered, turned])
def test_a_fault_in_the_export_fails_the_first_hits(
    renderer: Renderer, fault: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = adapter.triangles_of_scene
    monkeypatch.setattr(adapter, "triangles_of_scene", lambda scene: fault(right(scene)))
    assert cell_of(renderer, "first-hits", tmp_path).verdict == Verdict.FAIL


@needs_embree
@pytest.mark.parametrize("fault", ["no shadows", "sun turned", "larger offset"])
def test_a_fault_in_the_shadow_rays_fails_the_image(
    fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = adapter._shadow_rays
    if fault == "larger offset":
        monkeypatch.setattr(adapter, "RAY_OFFSET", 0.5)
    elif fault == "no shadows":
        monkeypatch.setattr(
            adapter, "_shadow_rays", lambda light: right(light).model_copy(update={"vector": (0.0, 1e-9, 0.0)})
        )
    else:
        monkeypatch.setattr(
            adapter,
            "_shadow_rays",
            lambda light: right(light).model_copy(update={"vector": (0.9, 0.3, 0.0), "is_near": False}),
        )
    assert cell_of(RENDERERS[0], "direct", tmp_path).verdict == Verdict.FAIL


@pytest.mark.parametrize("renderer", RENDERERS, ids=lambda renderer: renderer.name)
def test_spheres_are_refused_and_all_triangle_scenes_have_first_hits(renderer: Renderer) -> None:
    assert "no spheres" in str(renderer.refuses(build(objects=[BALL, ROOF])))
    comparable = 0
    for name in library_names():
        scene = open_scene(name)
        reason = depth_or_reason(scene, renderer, renderer.integrators[0])
        assert isinstance(reason, str) == any(isinstance(shape, Sphere | Plane) for shape in scene.objects), name
        comparable += reason == 0
    assert comparable >= 9


def test_a_worker_that_writes_nothing_is_an_error_even_over_an_old_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / RESULT_FILE).write_bytes(b"old")
    monkeypatch.setattr(adapter, "run_isolated", lambda *_, **__: None)
    with pytest.raises(RendererError, match=r"Embree's result\.npz cannot be read"):
        embree().render(build(objects=[ROOF]), "first-hits", 0, expectation(embree()).rays, tmp_path)


def test_where_the_worker_cannot_run_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    adapter._trial.cache_clear()
    monkeypatch.setattr(adapter.sys, "executable", "/nowhere/python")
    assert embree().version() is None
    adapter._trial.cache_clear()


@needs_embree
def test_the_parent_process_never_loads_embree() -> None:
    source = "import sys; from raytruth.comparisons.renderers.embree.adapter import embree; "
    source += "print(embree().version(), 'embreex' in sys.modules)"
    told = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True).stdout
    assert re.fullmatch(r"embreex \S+ False\n", told)
