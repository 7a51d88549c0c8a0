"""What docs/found.md tells of other renderers is still so: who mends it makes a test fail, and a section goes."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import raytruth
from raytruth.comparisons.records.renderings import Rays, RendererError
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.rendering import primary_rays
from raytruth.scenes.library import library_names
from tests.rooms import ROOT

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-12")

FOLDER = ROOT / "scenes" / "found"
PAGE = (ROOT / "docs" / "found.md").read_text(encoding="utf-8")
# Scene, renderer, integrator, column, row, what it gives, what is right.
TABLE = re.findall(
    r"^\| `([\w-]+)` \| `(\w+)` \| `(\w+)` \| (\d+), (\d+) \| ([\d.]+) \| ([\d.]+) \|", PAGE, re.MULTILINE
)
PROGRAMS = Path(__file__).parent / "found"
# Set where every reference must be there: a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))
# There is a wheel of Blender for one Python only.
REQUIRED = dict.fromkeys(("povray", "mitsuba", "vtk"), REQUIRE_ALL) | {
    "cycles": REQUIRE_ALL and sys.version_info[:2] == (3, 11)
}
# The independent sampler draws such a picture in milliseconds.
LONG_ENOUGH = 5.0


def needs(name: str) -> None:
    """Leave a test out where its renderer is not installed and need not be."""
    if not REQUIRED[name] and all_renderers()[name].version() is None:
        pytest.skip(f"{name} is not installed")


def told(program: str, folder: Path, *arguments: str) -> str:
    """The last line that a program of tests/meta/found/ prints."""
    command = [sys.executable, str(PROGRAMS / program), *arguments]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return run.stdout.splitlines()[-1]


def radiance(scene: Scene, column: int, row: int) -> float:
    return float(raytruth.render(scene)[row, column, 0])


def test_the_table_names_defects_and_every_scene_is_told_and_none_is_in_the_library() -> None:
    scenes = {path.stem for path in FOLDER.glob("*.json")}
    assert len(TABLE) == len(re.findall(r"^\| `", PAGE, re.MULTILINE)) > 0
    assert {row[0] for row in TABLE} <= scenes
    assert {name for name in scenes if f"`{name}`" in PAGE or f"scenes/found/{name}.json" in PAGE} == scenes
    assert scenes.isdisjoint(library_names())


@pytest.mark.parametrize("line", TABLE, ids=lambda line: "-".join(line[:2]))
def test_a_renderer_still_gives_what_the_page_tells(line: tuple[str, ...], tmp_path: Path) -> None:
    name, renderer_name, integrator, *numbers = line
    column, row = map(int, numbers[:2])
    given, right = map(float, numbers[2:])
    scene = raytruth.load_scene(FOLDER / f"{name}.json")
    digits = len(numbers[3].partition(".")[2])
    assert round(radiance(scene, column, row), digits) == right
    needs(renderer_name)
    renderer = all_renderers()[renderer_name]
    rays = Rays(*primary_rays(scene))
    # One surface is lit, which Mitsuba counts.
    image = renderer.render(scene, integrator, max(1, scene.max_depth), rays, tmp_path).image
    assert image is not None
    value = float(image[row, column, 0])
    assert abs(value - given) < abs(value - right), (
        f"{renderer.version()} gives {value}, as is right or otherwise wrong"
    )


def test_mitsuba_loads_no_scene_with_a_shining_triangle_without_area(tmp_path: Path) -> None:
    needs("mitsuba")
    scene = raytruth.load_scene(FOLDER / "shining-needle.json")
    assert raytruth.render(scene).any()
    with pytest.raises(RendererError, match="no probability mass"):
        all_renderers()["mitsuba"].render(scene, "path", 1, Rays(*primary_rays(scene)), tmp_path)


def test_mitsubas_stratified_sampler_never_ends_where_light_is_traced_forward() -> None:
    needs("mitsuba")
    command = [sys.executable, str(PROGRAMS / "forward_light.py"), str(FOLDER / "light-forward.json")]
    with subprocess.Popen([*command, "independent", "stratified"], stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        try:
            assert program.stdout.readline().startswith("independent ")
            with pytest.raises(subprocess.TimeoutExpired):
                program.wait(LONG_ENOUGH)
        finally:
            program.kill()


@pytest.mark.parametrize(("pattern", "is_right"), [("TABULATED_SOBOL", True), ("SOBOL_BURLEY", False)])
def test_single_samples_of_cycles_have_the_right_mean_in_one_pattern_only(
    pattern: str, is_right: bool, tmp_path: Path
) -> None:
    needs("cycles")
    scene = FOLDER / "thick-slab.json"
    mean = float(told("sampling_pattern.py", tmp_path, str(scene), pattern))
    # Hoeffding 1963, theorem 2, for 256 samples in [0, 1] of each pixel: a right mean is off by more once in a million.
    bound = np.sqrt(np.log(2e6) / 2 / (256 * 8 * 6))
    right = float(raytruth.render(raytruth.load_scene(scene))[..., 0].mean())
    assert (abs(mean - right) < bound) == is_right


def test_vtk_puts_a_lamp_of_a_gltf_file_one_unit_beside_its_node_and_lets_it_shine_as_bright_at_any_distance(
    tmp_path: Path,
) -> None:
    needs("vtk")
    file = FOLDER / "lamp-above-wall.json"
    scene = raytruth.load_scene(file)
    found = json.loads(told("gltf_light.py", tmp_path, str(file)))
    away = np.subtract(found["position"], scene.lights[0].position)
    assert away == pytest.approx([0, 0, 1], abs=1e-6)  # float32's rounding of numbers below 4
    assert found["attenuation"] == [1, 0, 0]
    right = radiance(scene, 0, 5) / radiance(scene, 4, 2)
    # Both pixels are rounded to 8 bits, half a code of some 100 at least, before the power 2.2 is undone.
    bound = right * 2.2 * 2 * 0.5 / 100
    as_opened, at_its_node, attenuated = (abs(ratio - right) < bound for ratio in found["seen"])
    assert (as_opened, at_its_node, attenuated) == (False, False, True)
