"""The example tracers, written from the documents alone in six languages, are right wherever they can be built."""

from __future__ import annotations

import json
import shutil
import subprocess
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.comparisons.judgement.pixel_verdict import MOST_UNJUDGED
from raytruth.comparisons.renderers.program.declaration_file import load_declaration
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration
from raytruth.reference_tracer.certified_image import certified_image
from raytruth.scenes.exporters.json_scene import export_json
from raytruth.scenes.features import Feature
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.loading import load_scene
from raytruth.scenes.requirements import required_features
from tests.meta.example_tracers import LANGUAGES, ROOT, built, copies, needs
from tests.raytruth.running import run
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.records.results import Judgement
    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("PRJ-8")

__all__ = ["copies"]  # a fixture, which tests ask for by its name

FLOAT64_BITS = 53


def render(copies: Path, language: str, scene_file: Path) -> NDArray[np.float32]:
    """What the tracer writes, by the command that it declares."""
    output = scene_file.with_suffix(".pfm")
    words = {"{scene}": str(scene_file), "{output}": str(output)}
    command = [words.get(word, word) for word in built(copies, language)["command"]]
    subprocess.run(command, cwd=copies / language, check=True, capture_output=True)
    return read_pfm(output)


def read_pfm(output: Path) -> NDArray[np.float32]:
    hints = OpenImageIO.ImageSpec()
    hints.attribute("pnm:pfmflip", 1)  # a PFM begins with its lowest row
    return np.asarray(OpenImageIO.ImageBuf(str(output), 0, 0, hints).get_pixels("float"))


@cache
def covering_scenes() -> tuple[Scene, ...]:
    """Scenes of the library, small, that together require every feature: each the one that adds most."""
    features = {name: required_features(open_scene(name)) for name in library_names()}
    chosen: list[str] = []
    missing = set(Feature)
    while missing:
        chosen.append(max(features, key=lambda name: len(features[name] & missing)))
        missing -= features[chosen[-1]]
    # None of these is a feature's name: parallel rays, what lies outside of glass, and meshes of many triangles.
    more = {"parallel-projection", "bubble-in-glass", "trefoil-knot"}
    return tuple(library_scene(name) for name in (*chosen, *sorted(more - set(chosen))))


EXPECTATIONS: dict[tuple[str, int], tuple[CertifiedImage, FeasibleSet]] = {}
"""By scene and bits, for all languages."""


def expectation(scene: Scene, bits: int) -> tuple[CertifiedImage, FeasibleSet]:
    key = (scene.model_dump_json(), bits)
    if key not in EXPECTATIONS:
        truth = certified_image(scene)
        EXPECTATIONS[key] = truth, feasible_set(scene, ErrorModel("float64", bits), truth=truth)
    return EXPECTATIONS[key]


def judged(copies: Path, language: str, scene: Scene, scene_file: Path) -> Judgement:
    """By the bits that the tracer declares, and nothing else."""
    arithmetic = built(copies, language)["arithmetic"]
    assert arithmetic["precision"] == "float64"
    truth, feasible = expectation(scene, FLOAT64_BITS - arithmetic["slack_bits"])
    return judge_image(render(copies, language, scene_file), truth.middle, feasible)[0]


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_tracer_is_right_on_scenes_that_need_every_feature(copies: Path, language: str, tmp_path: Path) -> None:
    for scene in covering_scenes():
        judgement = judged(copies, language, scene, export_json(scene, tmp_path))
        assert judgement.failing == 0, (scene.name, judgement.worst)
        assert judgement.unjudged == 0, scene.name


@needs("cpp")
@pytest.mark.parametrize("name", ["tracer-float32", "tracer-float32-fast", "tracer-float32-epsilon"])
@pytest.mark.parametrize("scene_name", ["glass-sphere", "bubble-in-glass", "classical-glass"])
def test_what_is_written_in_float32_is_judged_on_glass_and_right(
    copies: Path, name: str, scene_name: str, tmp_path: Path
) -> None:
    built(copies, "cpp")
    declaration = load_declaration(copies / "cpp" / f"{name}.toml")
    scene = library_scene(scene_name)
    scene_file, output = export_json(scene, tmp_path), tmp_path / "output.pfm"
    subprocess.run([copies / "cpp" / name, scene_file, output], check=True)
    truth = certified_image(scene)
    feasible = feasible_set(scene, error_model_of_declaration(declaration), truth=truth)
    judgement, _ = judge_image(read_pfm(output), truth.middle, feasible)
    assert judgement.failing == 0, judgement.worst
    # Where less is judged, the cell is incomparable, and tests nothing.
    assert judgement.unjudged <= MOST_UNJUDGED * judgement.pixels


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_tracer_reads_meshes_from_the_files_that_scenes_name(copies: Path, language: str, tmp_path: Path) -> None:
    folder = ROOT / "scenes" / "library"
    stated = json.loads((folder / "trefoil-knot.json").read_text(encoding="utf-8"))
    stated["camera"] |= {"width": 12, "height": 9}
    scene_file = tmp_path / "trefoil-knot.json"
    scene_file.write_text(json.dumps(stated), encoding="utf-8")
    shutil.copy(folder / "trefoil-knot.obj", tmp_path)
    assert judged(copies, language, library_scene("trefoil-knot"), scene_file).failing == 0


TRACED_PIXELS = (("glass-sphere", "10,7"), ("tinted-glass", "10,7"), ("concave-mirror", "10,7"), ("two-lights", "9,9"))


@pytest.mark.clause("GRD-9")
@pytest.mark.parametrize("language", LANGUAGES)
def test_each_tracer_prints_right_rays(copies: Path, language: str, capsys: pytest.CaptureFixture[str]) -> None:
    built(copies, language)
    given = ["--renderer-file", str(copies / language / "tracer.toml")]
    for scene, pixel in TRACED_PIXELS:
        status, out, _ = run(capsys, "trace", scene, "--quick", "--pixel", pixel, *given)
        assert status == 0, out


@needs("cpp")
@pytest.mark.clause("GRD-9")
def test_rays_are_right_in_float32_and_with_an_epsilon(copies: Path, capsys: pytest.CaptureFixture[str]) -> None:
    built(copies, "cpp")
    program = [str(copies / "cpp" / "tracer-float32-epsilon"), "{scene}", "{output}.pfm"]
    for scene, pixel in TRACED_PIXELS:
        status, out, _ = run(capsys, "trace", scene, "--quick", "--pixel", pixel, "--", *program)
        assert status == 0, out


# Names in two spellings of JSON, nulls, numbers in several forms, a polygon of an OBJ file, and no key that has a
# default: `max_depth`, `up`, `size`, `plane` and `offset` among them.
ODDLY_WRITTEN = r"""{"purpose": "A \"test\"\n", "convention": "radiometric", "max_depth": 2,
 "camera": {"projection": "orthographic", "position": [0.0, 0, 5e0], "look_at": [0, 0, 0], "up": [1, 2, 0],
  "view_height": 3.25, "width": 12, "height": 9, "inside": null},
 "lights": [{"kind": "directional", "direction": [-1, -2, -3], "irradiance": [2, 1.5, 1E+0]}],
 "materials": {"gl\u00e4s \ud83d\ude00": {"dielectric": {"index_of_refraction": 15e-1, "absorption": null}},
  "\/": {"mirror": null, "dielectric": {"index_of_refraction": 1.1, "outside": "gläs 😀"}},
  "board": {"diffuse": {"reflectance": {"checkerboard": {"even": [0.9, 0.8, 0.7], "odd": [0.1, 0.2, 0.3]}}}}},
 "objects": [{"shape": "sphere", "center": [0, 0, 0.125], "radius": 1, "material": "gläs \uD83D\uDE00"},
  {"shape": "sphere", "center": [0.1, 0, 0.2], "radius": 0.5, "material": "/"},
  {"shape": "mesh", "file": "board.obj", "material": "board"}]}"""
BOARD = "# a square\nv -4 -4 -2\nv 4 -4 -2.5\nv 4 4 -3 1\nvn 0 0 1\n\nv -4 4 -2.5\nf 1/1/1 -3//1 3/2 4\n"


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_tracer_reads_what_json_and_obj_allow(copies: Path, language: str, tmp_path: Path) -> None:
    scene_file = tmp_path / "odd.json"
    scene_file.write_text(ODDLY_WRITTEN, encoding="utf-8")
    (tmp_path / "board.obj").write_text(BOARD, encoding="utf-8")
    assert judged(copies, language, load_scene(scene_file), scene_file).failing == 0


def test_a_tracer_with_one_line_wrong_fails(copies: Path, tmp_path: Path) -> None:
    source = copies / "python" / "tracer.py"
    right = source.read_text(encoding="utf-8")
    scene = library_scene("glass-sphere")
    for line, wrong in {
        "glass.index / outer if enters": "outer / glass.index if enters",
        "(eta * eta * c - g) / (eta * eta * c + g)": "(eta * c - g) / (eta * c + g)",
        "y = (row + 0.5 - camera.height / 2)": "y = (row - camera.height / 2)",
    }.items():
        assert line in right
        source.write_text(right.replace(line, wrong), encoding="utf-8")
        assert judged(copies, "python", scene, export_json(scene, tmp_path)).failing > 0, wrong
    source.write_text(right, encoding="utf-8")
