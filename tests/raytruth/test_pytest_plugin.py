from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.raytruth.plugin_runs import environment_with_plugin, run_pytest

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-5")

CHEAP = """
import sys

def test_nothing_of_raytruth_is_loaded_but_the_plugin():
    ours = {name for name in sys.modules if name.partition(".")[0] == "raytruth"}
    assert ours == {"raytruth", "raytruth.pytest_plugin"}
    assert "numpy" not in sys.modules
"""


@pytest.fixture
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return environment_with_plugin(tmp_path_factory.mktemp("installed"))


def test_a_run_that_names_no_program_loads_nothing(tmp_path: Path, environment: dict[str, str]) -> None:
    (tmp_path / "test_cheap.py").write_text(CHEAP, encoding="utf-8")
    finished = run_pytest(tmp_path, environment, "-W", "error")
    assert "1 passed" in finished.stdout
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".py" and path.name != "__pycache__"] == []


@pytest.mark.clause("CMD-2")
def test_bad_usage_is_a_sentence_and_ends_pytest(tmp_path: Path, environment: dict[str, str]) -> None:
    finished = run_pytest(tmp_path, environment, "--raytruth-file", "nothing.toml")
    assert finished.returncode == pytest.ExitCode.USAGE_ERROR
    assert finished.stderr.startswith("ERROR: nothing.toml: expected a TOML file")
    assert "Traceback" not in finished.stdout + finished.stderr
    assert list(tmp_path.iterdir()) == []
