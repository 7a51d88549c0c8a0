"""Runs pytest with raytruth's plugin in a process of its own, as whoever has raytruth installed does."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from pathlib import Path

from tests.comparisons.renderers.third_party.installed import pretend_installed

ROOT = Path(__file__).parents[2]
ENTRY_POINTS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["entry-points"]


def environment_with_plugin(folder: Path) -> dict[str, str]:
    """The variables of processes in which this raytruth is installed; writes its metadata into the folder."""
    pretend_installed(folder, "raytruth", "0.1.0", "pytest11", ENTRY_POINTS["pytest11"])
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])}


def run_pytest(folder: Path, environment: dict[str, str], *arguments: str) -> subprocess.CompletedProcess[str]:
    """Pytest in a working directory."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
