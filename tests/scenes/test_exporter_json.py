from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.rendering import render
from raytruth.scenes.exporters.json_scene import export_json, notes, refuses
from raytruth.scenes.exporters.json_text import json_text
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.loading import LARGEST_SCENE_FILE, MOST_MESH_FILES, load_scene
from raytruth.scenes.shapes import Mesh
from tests.scenes.exporter_scenes import BALL, MIRROR, RED, build

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-2")

values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


@given(values)
def test_text_reads_back_as_the_value(value: Any) -> None:
    assert json.loads(json_text(value)) == value


def test_numbers_stay_on_a_line_and_what_holds_more_does_not() -> None:
    assert json_text({"a": [1.0, 2.0], "b": []}) == '{\n  "a": [1.0, 2.0],\n  "b": []\n}\n'
    with pytest.raises(ValueError, match="JSON compliant"):
        json_text([math.inf])


def without_file_names(scene: Scene) -> Scene:
    objects = tuple(
        shape.model_copy(update={"file": None}) if isinstance(shape, Mesh) else shape for shape in scene.objects
    )
    return scene.model_copy(update={"objects": objects})


@pytest.mark.parametrize("name", library_names())
def test_a_scene_loads_from_one_file_as_the_same(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    assert refuses(scene) is None
    assert notes(scene) == []
    path = export_json(scene, tmp_path)
    assert list(tmp_path.iterdir()) == [path]
    assert load_scene(path) == without_file_names(scene)


# A mesh from a file, a whole ray tree, a camera under water.
@pytest.mark.parametrize("name", ["trefoil-knot", "whitted-1980", "camera-under-water"])
def test_the_image_is_the_same(name: str, tmp_path: Path) -> None:
    scene = open_scene(name)
    small = scene.resized(16, 12)
    image = render(load_scene(export_json(small, tmp_path)))
    assert np.asarray(image).any()
    np.testing.assert_array_equal(image, render(small))


def test_names_may_hold_anything_and_numbers_may_be_extreme(tmp_path: Path) -> None:
    name = 'a "quoted"\n\\ – name'
    ball = BALL | {"material": name, "center": (1e12, -0.0, 5e-324), "radius": 1 / 3}
    scene = build(purpose="Zeile\u2028um", materials={name: RED, "unused": MIRROR}, objects=[ball])
    loaded = load_scene(export_json(scene, tmp_path))
    assert loaded == scene.model_copy(update={"name": "scene"})


def large_mesh() -> dict[str, Any]:
    """Some 60 bytes a vertex, so that one mesh is too long for a scene file."""
    vertices = np.random.default_rng(1).normal(size=(LARGEST_SCENE_FILE // 50, 3)).tolist()
    return {"shape": "mesh", "vertices": vertices, "faces": [(0, 1, 2), (2, 1, 3)], "material": "m"}


def test_meshes_lie_beside_a_scene_that_would_be_too_long(tmp_path: Path) -> None:
    scene = build(objects=[BALL, large_mesh()])
    assert "too long" in notes(scene)[0]
    path = export_json(scene, tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == {"scene.json", "mesh-1.obj"}
    assert without_file_names(load_scene(path)) == scene.model_copy(update={"name": "scene"})


@pytest.mark.parametrize("objects", [[BALL] * 12_000, [large_mesh(), *[large_mesh() | {"vertices": []}] * 100]])
def test_what_raytruth_would_not_read_again_is_refused(objects: list[dict[str, Any]], tmp_path: Path) -> None:
    assert len(objects) > MOST_MESH_FILES
    scene = build(objects=objects)
    assert "longer than raytruth reads" in (refuses(scene) or "")
    with pytest.raises(ValueError, match="because"):
        export_json(scene, tmp_path)
    assert list(tmp_path.iterdir()) == []
