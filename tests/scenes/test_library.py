from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from raytruth.scenes.library import LIBRARY_FOLDER, library_names, open_scene
from raytruth.scenes.loading import SceneError
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Mesh, Sphere
from tests.scenes.scene_files import valid_scene, write_scene

pytestmark = pytest.mark.clause("SCN-5")

SCENES = {name: open_scene(name) for name in library_names()}
DIELECTRIC_MESHES = [
    pytest.param(shape, id=f"{name}-{index}")
    for name, scene in SCENES.items()
    for index, shape in enumerate(scene.objects)
    if isinstance(shape, Mesh) and scene.materials[shape.material].dielectric is not None
]


def used(scene: Scene, term: str) -> bool:
    return any(getattr(scene.materials[shape.material], term) is not None for shape in scene.objects)


def test_names_are_sorted_lower_case_words_joined_by_hyphens() -> None:
    assert list(library_names()) == sorted(library_names())
    assert all(word.isalnum() and word == word.lower() for name in library_names() for word in name.split("-"))
    assert all(scene.name == name for name, scene in SCENES.items())


@pytest.mark.parametrize("name", library_names())
def test_every_scene_states_its_purpose_in_one_sentence(name: str) -> None:
    purpose = SCENES[name].purpose
    assert purpose.endswith(".")
    assert purpose.count(". ") == 0


@pytest.mark.parametrize("name", library_names())
def test_every_material_of_a_scene_is_used(name: str) -> None:
    scene = SCENES[name]
    outside = {m.dielectric.outside for m in scene.materials.values() if m.dielectric is not None}
    assert set(scene.materials) == {shape.material for shape in scene.objects} | (outside - {None})


@pytest.mark.parametrize("name", library_names())
def test_images_are_small_enough_for_certified_rendering(name: str) -> None:
    scene = SCENES[name]
    noisy_reference = scene.convention == "radiometric" and used(scene, "dielectric")
    # Certified rendering takes up to 0.5 ms a pixel (10 s an image); a noisy reference needs many samples a pixel.
    limit = 64 * 64 if noisy_reference else 160 * 120
    assert scene.camera.width * scene.camera.height <= limit


@pytest.mark.parametrize("name", library_names())
def test_scenes_with_reflection_or_refraction_state_a_depth_and_others_none(name: str) -> None:
    scene = SCENES[name]
    assert (scene.max_depth > 0) == (used(scene, "mirror") or used(scene, "dielectric"))


@pytest.mark.parametrize("name", library_names())
def test_every_glowing_checkerboard_is_on_a_flat_surface(name: str) -> None:
    scene = SCENES[name]
    for shape in scene.objects:
        emission = scene.materials[shape.material].emission
        if emission is not None and isinstance(emission.radiance, CheckerboardColor):
            assert not isinstance(shape, Sphere)


@pytest.mark.parametrize("mesh", DIELECTRIC_MESHES)
def test_every_dielectric_mesh_is_closed_and_turned_outward(mesh: Mesh) -> None:
    edges = Counter(edge for a, b, c in mesh.faces for edge in ((a, b), (b, c), (c, a)))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    assert six_volumes(mesh) > 0


def test_the_trefoil_is_closed_and_turned_outward_too() -> None:
    [mesh] = SCENES["trefoil-knot"].objects
    assert isinstance(mesh, Mesh)
    assert 2000 <= len(mesh.faces) <= 4000
    edges = Counter(edge for a, b, c in mesh.faces for edge in ((a, b), (b, c), (c, a)))
    assert all(edges[a, b] == edges[b, a] == 1 for a, b in edges)
    assert six_volumes(mesh) > 0


def six_volumes(mesh: Mesh) -> float:
    """The signed volume by Gauss's theorem, times 6."""
    total = 0.0
    for face in mesh.faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (mesh.vertices[index] for index in face)
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total


def test_the_two_projections_differ_in_nothing_but_the_camera() -> None:
    assert differences("parallel-projection", "perspective-projection") == {"camera", "name", "purpose"}


def test_the_facing_mirrors_differ_in_nothing_but_the_depth() -> None:
    assert differences("facing-mirrors-depth-2", "facing-mirrors-depth-8") == {"max_depth", "name", "purpose"}


def test_phong_and_blinn_differ_in_nothing_but_the_model() -> None:
    phong, blinn = ((LIBRARY_FOLDER / f"{name}-sphere.json").read_text(encoding="utf-8") for name in ("phong", "blinn"))
    assert json.loads(phong)["materials"] == json.loads(blinn.replace('"blinn"', '"phong"'))["materials"]
    assert differences("phong-sphere", "blinn-sphere") == {"materials", "name", "purpose"}


def differences(first: str, second: str) -> set[str]:
    a, b = SCENES[first], SCENES[second]
    return {field for field in Scene.model_fields if getattr(a, field) != getattr(b, field)}


def test_an_unknown_name_suggests_the_nearest() -> None:
    with pytest.raises(SceneError, match="did you mean 'cornell-box'") as caught:
        open_scene("cornel-box")
    assert len(caught.value.problems) == 1


@pytest.mark.parametrize("name", ["", "../library/cornell-box", "cornell-box\0", "scenes"])
def test_a_name_that_is_no_scene_is_refused(name: str) -> None:
    with pytest.raises(SceneError, match="expected a scene of the library or the path"):
        open_scene(name)


def test_a_path_opens_a_file(tmp_path: Path) -> None:
    assert open_scene(str(write_scene(tmp_path, valid_scene()))).name == "spoilt"


def test_a_folder_called_scenes_in_the_working_directory_does_not_disturb(tmp_path: Path) -> None:
    (tmp_path / "scenes" / "library").mkdir(parents=True)
    program = "from raytruth.scenes.library import open_scene; print(open_scene('cornell-box').name)"
    result = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
        capture_output=True,
        text=True,
        check=True,
    )
    assert result.stdout == "cornell-box\n"
