"""What is kept depends on all the code that makes it, and on no more: a change elsewhere leaves it valid."""

from __future__ import annotations

import inspect
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from raytruth.comparisons.feasible_sets.kept_feasible_sets import FEASIBLE_SET_ROOMS
from raytruth.comparisons.kills.kill_run import KILL_ROOMS
from raytruth.comparisons.matrix.cell_key import CELL_ROOMS, files_used
from raytruth.comparisons.matrix.kept_versions import TRIAL_ROOMS
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.certified_image import TRUTH_ROOMS
from raytruth.reference_tracer.storage.source_digest import ROOT, files_of_room

pytestmark = pytest.mark.clause("RES-3")

EVERYWHERE = tuple(path.name for path in ROOT.iterdir() if path.is_dir())

MADE_BY = [
    ("reference_tracer/certified_image.py", TRUTH_ROOMS),
    ("comparisons/feasible_sets/kept_feasible_sets.py", FEASIBLE_SET_ROOMS),
    ("comparisons/matrix/plan.py", CELL_ROOMS),
    ("comparisons/matrix/run.py", CELL_ROOMS),
    ("comparisons/measures/metrics.py", CELL_ROOMS),
    ("comparisons/kills/kill_matrix.py", KILL_ROOMS),
    ("comparisons/faults/catalogue.py", KILL_ROOMS),
    ("comparisons/faults/variants.py", KILL_ROOMS),
]
"""Which file makes a kept thing, and what that thing says it depends on."""

NOT_NEEDED = {
    "scenes/exporters/json_scene.py": "writes the quick suite's scenes; kills need how small its images are",
    "scenes/exporters/json_text.py": "as above",
    "scenes/exporters/obj_lines.py": "as above",
}
"""What is imported and has no part in what is made, with the reason."""


def forgotten(start: Path, rooms: tuple[str, ...], *besides: Path) -> set[str]:
    """The files that a file uses, directly or through others, and that no room holds."""
    named = {file for room in rooms for file in files_of_room(room)}.union(besides)
    return {str(file.relative_to(ROOT)) for file in files_used(start, ROOT, EVERYWHERE) - named} - NOT_NEEDED.keys()


@pytest.mark.parametrize(("start", "rooms"), MADE_BY, ids=[start for start, _ in MADE_BY])
def test_all_code_that_makes_a_kept_thing_lies_in_a_room_that_it_names(start: str, rooms: tuple[str, ...]) -> None:
    assert forgotten(ROOT / start, rooms) == set()


@pytest.mark.parametrize("rooms", [TRIAL_ROOMS, CELL_ROOMS], ids=["trials", "cells"])
@pytest.mark.parametrize("name", all_renderers())
def test_all_code_of_a_renderer_is_its_own_or_lies_in_a_room(name: str, rooms: tuple[str, ...]) -> None:
    adapter = Path(inspect.getfile(type(all_renderers()[name])))
    assert forgotten(adapter, rooms, *files_used(adapter, ROOT)) == set()


def test_a_room_that_is_not_named_is_found_out() -> None:
    start = ROOT / "comparisons/feasible_sets/kept_feasible_sets.py"
    without = tuple(room for room in FEASIBLE_SET_ROOMS if room != "comparisons/records/srgb.py")
    assert forgotten(start, without) == {"comparisons/records/srgb.py"}
    assert "scenes/scene.py" in forgotten(start, ("comparisons/error_models",))


KEYS = """
import json
from raytruth.comparisons.feasible_sets.kept_feasible_sets import feasible_set_key
from raytruth.comparisons.kills.kill_run import kills_key
from raytruth.comparisons.matrix.cell_key import cell_key, scene_digest
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.certified_image import truth_key
from raytruth.scenes.library import open_scene
scene = open_scene("single-sphere")
keys = {"truth": truth_key(scene), "feasible set": feasible_set_key(scene), "kills": kills_key(scene)}
for name, renderer in all_renderers().items():
    keys[name] = cell_key(scene_digest(scene), renderer, renderer.integrators[0], "1")
print(json.dumps(keys))
"""
"""Prints what the kept things of a scene are known by."""

KEPT_ALWAYS = {"truth", "feasible set", *all_renderers()}


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of all our code, in a folder of its own."""
    folder = tmp_path_factory.mktemp("copied")
    ignored = shutil.ignore_patterns("__pycache__", "*.pyc")
    return Path(shutil.copytree(ROOT, folder / "raytruth", ignore=ignored))


def keys(package: Path) -> dict[str, str]:
    environment = os.environ | {"PYTHONPATH": str(package.parent), "PYTHONDONTWRITEBYTECODE": "1"}
    told = subprocess.run(
        [sys.executable, "-c", KEYS], cwd=package.parent, env=environment, capture_output=True, check=True
    )
    return json.loads(told.stdout)


@pytest.fixture(scope="module")
def before(package: Path) -> dict[str, str]:
    return keys(package)


def changed(package: Path, before: dict[str, str], files: list[str], addition: str) -> set[str]:
    """What is no longer valid once the addition stands at the end of these files; they are left as they were."""
    texts = {package / name: (package / name).read_text(encoding="utf-8") for name in files}
    try:
        for path, text in texts.items():
            path.write_text(text + addition, encoding="utf-8")
        after = keys(package)
    finally:
        for path, text in texts.items():
            path.write_text(text, encoding="utf-8")
    return {name for name, key in after.items() if key != before[name]}


ELSEWHERE = [
    str(path.relative_to(ROOT))
    for folder in ("comparisons/faults", "comparisons/kills", "specification", "reports", ".")
    for path in sorted((ROOT / folder).glob("*.py"))
]
"""Faults, kills, specification, reports and the command line."""


def test_a_change_in_faults_kills_reports_or_the_command_line_leaves_cells_and_feasible_sets_valid(
    package: Path, before: dict[str, str]
) -> None:
    assert len(ELSEWHERE) > 40
    assert changed(package, before, ELSEWHERE, "\n\ndef one_more() -> int:\n    return 1\n") == {"kills"}


def test_a_comment_leaves_everything_valid_wherever_it_is(package: Path, before: dict[str, str]) -> None:
    files = [str(path.relative_to(package)) for path in package.rglob("*.py")]
    assert set(ELSEWHERE) < {str(Path(file)) for file in files}
    assert changed(package, before, files, "\n# A comment.\n") == set()


@pytest.mark.parametrize(
    ("files", "invalid"),
    [
        (["reference_tracer/source/sphere.py"], {"kills", *KEPT_ALWAYS}),
        (["comparisons/error_models/ray_offsets.py"], {"kills", *KEPT_ALWAYS} - {"truth"}),
        (["comparisons/noise/lobes.py"], KEPT_ALWAYS - {"truth", "feasible set"}),
        (
            ["comparisons/renderers/mitsuba/worker.py", "scenes/exporters/povray.py"],
            {"mitsuba", "mitsuba-llvm", "povray"},
        ),
    ],
    ids=["the tracer", "an error model", "the noise", "adapters and exporters"],
)
def test_a_change_makes_what_depends_on_it_invalid_and_nothing_else(
    files: list[str], invalid: set[str], package: Path, before: dict[str, str]
) -> None:
    assert changed(package, before, files, "\nONE_MORE = 1\n") == invalid
