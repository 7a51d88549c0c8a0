from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import raytruth
from raytruth.scenes.library import LIBRARY_FOLDER
from tests.raytruth.running import run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SCN-1")


def test_a_scene_is_loaded_by_its_name_or_by_its_path() -> None:
    path = LIBRARY_FOLDER / "two-lights.json"
    assert raytruth.load_scene("two-lights") == raytruth.load_scene(path) == raytruth.load_scene(str(path))


@pytest.mark.clause("CMD-2")
def test_what_is_wrong_with_a_scene_is_what_the_command_line_prints(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text("{}")
    for scene in ("two-light", str(tmp_path / "missing.json"), str(broken)):
        with pytest.raises(raytruth.SceneError) as caught:
            raytruth.load_scene(scene)
        status, _, told = run(capsys, "explain", scene, "--pixel", "0,0")
        assert (status, told) == (2, f"raytruth: {caught.value}\n")
        assert str(caught.value).splitlines() == list(caught.value.problems)
