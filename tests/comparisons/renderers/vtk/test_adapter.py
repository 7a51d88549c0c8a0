"""VTK itself, judged by the matrix; what it cannot express is refused; faults in what it draws are caught."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.records.renderings import Rays, RendererError
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.vtk import adapter
from raytruth.comparisons.renderers.vtk.adapter import Vtk
from raytruth.comparisons.renderers.vtk.job import RESULT_FILE
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.shapes import Plane, Sphere
from tests.comparisons.drawn_triangles import ORTHOGRAPHIC, PERSPECTIVE
from tests.comparisons.renderers.vtk.vtk_cells import cell_of, needs_vtk
from tests.scenes.exporter_scenes import BALL, GLASS, build

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

    Arrays = dict[str, NDArray[Any]]

pytestmark = pytest.mark.clause("REN-4")

PROJECTIONS = pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC], ids=["perspective", "orthographic"])
TRIANGLE_SCENES = [
    name for name in library_names() if not any(isinstance(shape, Sphere | Plane) for shape in open_scene(name).objects)
]

# It reaches behind the camera and far to the sides, so that it is cut.
FLOOR = {
    "shape": "mesh",
    "vertices": ((-29.0, -1.1, -19.0), (-29.0, -1.1, 19.0), (29.0, -1.1, 19.0), (29.0, -1.1, -19.0)),
    "faces": ((0, 1, 2), (0, 2, 3)),
    "material": "m",
}
ROOF = {"shape": "triangle", "vertices": ((-0.7, 0.4, 0.3), (0.8, 0.6, 0.1), (0.1, 0.5, -0.9)), "material": "m"}


def small_scene(projection: dict[str, Any]) -> Scene:
    camera = {"position": (0.3, 1.2, 5.0), "look_at": (0.0, 0.1, 0.0), "width": 32, "height": 24}
    return build(objects=[ROOF, FLOOR], camera=camera | projection)


@needs_vtk
@PROJECTIONS
def test_a_roof_over_a_floor_that_is_cut_passes(projection: dict[str, Any], tmp_path: Path) -> None:
    cell = cell_of(small_scene(projection), "first-hits", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason
    assert cell.first_hits is not None
    assert cell.first_hits.compared == 32 * 24
    assert cell.first_hits.ambiguous < 20


@needs_vtk
@pytest.mark.parametrize("name", TRIANGLE_SCENES)
def test_every_triangle_scene_passes_with_parallel_rays_too(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    camera = scene.camera
    # As wide as what perspective shows at the distance of the point that is looked at.
    height = float(np.linalg.norm(np.subtract(camera.look_at, camera.position))) * 0.7
    parallel = {
        "projection": "orthographic",
        "position": camera.position,
        "look_at": camera.look_at,
        "up": camera.up,
        "width": 32,
        "height": 24,
        "view_height": height,
    }
    seen = build(**{**scene.model_dump(exclude={"camera"}), "camera": parallel})
    cell = cell_of(seen, "first-hits", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason


DRAWN = ("primitive", "depth", "drawn_normal")


def flipped(result: Arrays) -> Arrays:
    return result | {name: result[name][::-1] for name in DRAWN}


def mirrored(result: Arrays) -> Arrays:
    return result | {name: result[name][:, ::-1] for name in DRAWN}


def farther(result: Arrays) -> Arrays:
    return result | {"depth": result["depth"] * (1 + 2.0**-9)}


def shifted_by_a_pixel(result: Arrays) -> Arrays:
    return result | {name: np.roll(result[name], 1, axis=1) for name in DRAWN}


def one_wrong_number(result: Arrays) -> Arrays:
    primitive = result["primitive"].copy()
    assert primitive[20, 16] > 0
    primitive[20, 16] = 0
    return result | {"primitive": primitive}


def turned_normals(result: Arrays) -> Arrays:
    return result | {"normals": -result["normals"]}


def normals_a_little_to_the_right(result: Arrays) -> Arrays:
    """As from a matrix that is off by a hundredth of a percent."""
    return result | {"drawn_normal": result["drawn_normal"] + np.array([1e-4, 0.0, 0.0])}


def normals_of_the_pixel_beside(result: Arrays) -> Arrays:
    return result | {"drawn_normal": np.roll(result["drawn_normal"], 1, axis=1)}


@needs_vtk
@PROJECTIONS
@pytest.mark.parametrize(
    "fault",
    [
        flipped,
        mirrored,
        farther,
        shifted_by_a_pixel,
        one_wrong_number,
        turned_normals,
        normals_a_little_to_the_right,
        normals_of_the_pixel_beside,
    ],
)
def test_a_fault_in_what_is_drawn_fails(
    projection: dict[str, Any], fault: Callable[[Arrays], Arrays], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = adapter._run
    monkeypatch.setattr(adapter, "_run", lambda *arguments: fault(right(*arguments)))
    assert cell_of(small_scene(projection), "first-hits", tmp_path).verdict == Verdict.FAIL


def test_what_it_cannot_draw_is_refused() -> None:
    vtk = Vtk()
    assert "no spheres" in str(vtk.refuses(build(objects=[BALL, ROOF])))
    scene = small_scene(PERSPECTIVE)
    inside = build(materials={"m": GLASS}, objects=[ROOF], camera=scene.camera.model_dump() | {"inside": "m"})
    assert "no media" in str(vtk.refuses(inside))
    x, y, z = scene.camera.position
    around = {"shape": "triangle", "vertices": ((x, y, z), (0.5, 0.0, 0.0), (0.0, 0.0, 0.5)), "material": "m"}
    assert "in a surface" in str(vtk.refuses(build(objects=[around], camera=scene.camera.model_dump())))


def test_every_triangle_scene_of_the_library_is_comparable() -> None:
    for name in library_names():
        reason = depth_or_reason(open_scene(name), Vtk(), Vtk.integrators[0])
        assert isinstance(reason, str) == (name not in TRIANGLE_SCENES), name
    assert len(TRIANGLE_SCENES) >= 9


def test_a_worker_that_writes_nothing_is_an_error_even_over_an_old_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / RESULT_FILE).write_bytes(b"old")
    monkeypatch.setattr(adapter, "run_isolated", lambda *_, **__: None)
    scene = small_scene(PERSPECTIVE)
    with pytest.raises(RendererError, match=r"VTK's result\.npz cannot be read"):
        Vtk().render(scene, "first-hits", 0, Rays(*primary_rays(scene)), tmp_path)


def test_where_the_worker_cannot_run_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    adapter._trial.cache_clear()
    monkeypatch.setattr(adapter.sys, "executable", "/nowhere/python")
    assert Vtk().version() is None
    adapter._trial.cache_clear()


@needs_vtk
def test_the_parent_process_never_loads_vtk() -> None:
    assert "Mesa" in str(Vtk().version())
    assert not any(name.startswith("vtkmodules") for name in sys.modules)
