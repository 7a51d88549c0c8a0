from __future__ import annotations

import subprocess
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.sandboxes import control_groups as module
from raytruth.comparisons.sandboxes.control_groups import MEMBERS, control_groups

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SBX-4")

MEMORY = 64 << 20


def test_groups_have_the_limits_take_processes_and_are_gone_afterwards() -> None:
    """Where none can be made there are none, which is no error."""
    with control_groups(16, MEMORY) as files:
        for file in files:
            assert file.name == MEMBERS
            limits = [path.read_text().strip() for path in file.parent.glob("*max")]
            limits += [path.read_text().strip() for path in file.parent.glob("memory.limit_in_bytes")]
            assert {"16", str(MEMORY)} & set(limits)
            subprocess.run(["sh", "-c", 'echo 0 > "$0"', file], check=True)
    assert not any(file.parent.exists() for file in files)


def test_where_no_group_can_be_made_there_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_TREES", tmp_path)
    with control_groups(16, MEMORY) as files:
        assert files == []
    (tmp_path / "pids").mkdir()
    with control_groups(16, MEMORY) as files:
        assert files == []
    assert [path for path in tmp_path.rglob("*") if path.name.startswith("raytruth")] == []
