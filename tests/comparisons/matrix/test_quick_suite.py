from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix import quick_suite
from raytruth.comparisons.matrix.quick_suite import (
    MOST_PIXELS,
    quick_scenes,
    small,
    write_quick_scenes,
    write_quick_suite,
)
from raytruth.scenes.library import library_names, open_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("VER-12")


def test_the_suite_is_written_as_small_scene_files(tmp_path: Path) -> None:
    paths = write_quick_suite(tmp_path)
    assert [open_scene(path).name for path in paths] == list(quick_scenes())
    for path in paths:
        scene = open_scene(path)
        assert scene.camera == small(open_scene(scene.name)).camera


def test_another_suite_takes_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quick_suite, "QUICK_FILE", tmp_path / "quick.json")
    write_quick_scenes(["single-sphere"])
    assert quick_scenes() == ("single-sphere",)


@pytest.mark.parametrize("name", library_names())
def test_small_images_have_the_shape_of_the_scene_and_no_more_pixels_than_stated(name: str) -> None:
    camera, smaller = open_scene(name).camera, small(open_scene(name)).camera
    assert smaller.width * smaller.height <= MOST_PIXELS
    assert smaller.width * smaller.height > MOST_PIXELS / 3
    assert smaller.width / smaller.height == pytest.approx(camera.width / camera.height, rel=0.05)
