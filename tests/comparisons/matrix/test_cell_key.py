from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix.cell_key import ADAPTERS, cell_key, files_used, scene_digest
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.storage.source_digest import ROOT
from tests.comparisons.matrix.pretending import Pretender
from tests.reference_tracer.small_scenes import small_scene

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("RES-3")

FILES = {
    "comparisons/renderers/one.py": """
from raytruth.comparisons.renderers import one_job
from raytruth.scenes.exporters.one import export
command = ["python", "-m", "raytruth.comparisons.renderers.one_worker"]
""",
    "comparisons/renderers/one_job.py": """
import raytruth.comparisons.records.results
import raytruth.scenes.exporters.missing
if TYPE_CHECKING:
    import raytruth.comparisons.renderers.two
""",
    "comparisons/renderers/one_worker.py": "from raytruth.comparisons.renderers.one import command\n",
    "comparisons/renderers/two.py": "from raytruth.scenes.exporters import two\n",
    "comparisons/records/results.py": "import raytruth.scenes.exporters.two",
    "scenes/exporters/one.py": "import raytruth.scenes.exporters.shared\n",
    "scenes/exporters/two.py": "",
    "scenes/exporters/shared.py": "",
}


@pytest.fixture
def root(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def used(root: Path, name: str) -> set[str]:
    return {str(path.relative_to(root)) for path in files_used(root / name, root)}


def test_an_adapter_depends_on_what_it_imports_and_starts_and_on_no_other_adapter(root: Path) -> None:
    assert used(root, "comparisons/renderers/one.py") == {
        "comparisons/renderers/one.py",
        "comparisons/renderers/one_job.py",
        "comparisons/renderers/one_worker.py",
        "scenes/exporters/one.py",
        "scenes/exporters/shared.py",
    }
    assert used(root, "comparisons/renderers/two.py") == {"comparisons/renderers/two.py", "scenes/exporters/two.py"}


def test_folders_may_be_any_of_ours(root: Path) -> None:
    path = root / "comparisons/renderers/one_job.py"
    files = files_used(path, root, ("comparisons", "scenes"))
    assert {str(file.relative_to(root)) for file in files} == {
        "comparisons/renderers/one_job.py",
        "comparisons/records/results.py",
        "scenes/exporters/two.py",
    }


def test_the_adapters_here_depend_on_their_workers_and_exporters() -> None:
    mitsuba = used(ROOT, "comparisons/renderers/mitsuba/adapter.py")
    assert {"comparisons/renderers/mitsuba/worker.py", "scenes/exporters/mitsuba_materials.py"} <= mitsuba
    assert not any("povray" in name or "catalogue" in name for name in mitsuba)
    povray = used(ROOT, "comparisons/renderers/povray.py")
    assert not any("mitsuba" in name for name in povray)
    assert all(name.startswith(ADAPTERS) for name in mitsuba | povray)


def test_a_key_tells_scenes_renderers_integrators_and_versions_apart() -> None:
    embree, robust = all_renderers()["embree"], all_renderers()["embree-robust"]
    first, second = embree.integrators
    scene, other = scene_digest(small_scene(name="a")), scene_digest(small_scene(name="b"))
    keys = [
        cell_key(scene, embree, first, "1"),
        cell_key(other, embree, first, "1"),
        cell_key(scene, robust, first, "1"),
        cell_key(scene, embree, second, "1"),
        cell_key(scene, embree, first, "2"),
        cell_key(scene, Pretender(name="embree"), first, "1"),
    ]
    assert len(set(keys)) == len(keys)
    assert cell_key(scene_digest(small_scene(name="a")), embree, first, "1") == keys[0]
