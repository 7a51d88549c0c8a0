"""The package in examples/adapter-package/, as if it were installed."""

from __future__ import annotations

import json
import os
import tomllib
from pathlib import Path

import pytest

from raytruth.comparisons.renderers.third_party.entry_points import GROUP
from tests.comparisons.renderers.third_party.installed import pretend_installed
from tests.raytruth.running import run_apart

pytestmark = pytest.mark.clause("REN-11")

ROOT = Path(__file__).parents[4]
PACKAGE = ROOT / "examples" / "adapter-package"
PROJECT = tomllib.loads((PACKAGE / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_it_is_judged_as_our_own_and_a_broken_one_beside_it_is_told(tmp_path: Path) -> None:
    pretend_installed(tmp_path, PROJECT["name"], PROJECT["version"], GROUP, PROJECT["entry-points"][GROUP])
    pretend_installed(tmp_path, "broken", "0.1", GROUP, {"broken": "nothing:here"})
    path = os.pathsep.join([str(tmp_path), str(PACKAGE / "src"), str(ROOT)])
    scenes = ("ambient-sphere", "single-sphere")
    finished = run_apart(
        tmp_path, "run", *scenes, "--renderer", "flat", "--json", env={**os.environ, "PYTHONPATH": path}
    )
    assert finished.returncode == 0, finished.stderr
    cells = {cell["scene"]: cell for cell in json.loads(finished.stdout)["cells"]}
    verdicts = {scene: cell["verdict"] for scene, cell in cells.items()}
    assert verdicts == dict(zip(scenes, ("pass", "incomparable"), strict=True))
    assert "flat is not known to have what the scene requires: diffuse" in cells["single-sphere"]["reason"]
    assert "The renderer 'broken' of the package broken 0.1 is left out" in finished.stderr
    assert "Traceback" not in finished.stderr
