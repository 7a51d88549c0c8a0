from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.feasible_sets import kept_feasible_sets
from raytruth.comparisons.matrix import estimate, kept_versions, run
from tests.comparisons.matrix.pretending import Pretender

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def pretender(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Pretender:
    """The one renderer there is; scenes are rendered in this process, where it can be counted."""
    for module in (kept_versions, kept_feasible_sets, estimate):
        monkeypatch.setattr(module, "cache_folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    return Pretender()
