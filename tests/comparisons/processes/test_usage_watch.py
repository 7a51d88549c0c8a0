from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.processes import usage_watch
from raytruth.comparisons.processes.process_count import descendants_of
from raytruth.comparisons.processes.usage_watch import DEEPEST, MOST_FILES, UsageWatch

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("SBX-4")

MEBIBYTE = 1 << 20
PLENTY = 1 << 40


def watch(folder: Path, *, memory: int = PLENTY, file: int = MEBIBYTE) -> UsageWatch:
    """Of this process, as if it were a guard."""
    return UsageWatch(os.getpid(), folder, memory, file)


def test_all_files_together_may_be_twice_as_large_as_one(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    for number in range(2):
        (tmp_path / "deep" / str(number)).write_bytes(bytes(MEBIBYTE - 4096 * 4))
    assert watch(tmp_path).excess() is None
    (tmp_path / "more").write_bytes(bytes(MEBIBYTE))
    assert watch(tmp_path).excess() == "wrote more than 2 MiB in all"


def test_too_many_files_and_folders_that_are_too_deep_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "/".join(["d"] * (DEEPEST - 1))).mkdir(parents=True)
    assert watch(tmp_path).excess() is None
    (tmp_path / "/".join(["d"] * (DEEPEST + 1))).mkdir(parents=True)
    assert watch(tmp_path).excess() == f"made folders that are more than {DEEPEST} deep"
    monkeypatch.setattr(usage_watch, "MOST_FILES", 3)
    assert watch(tmp_path).excess() == "made more than 3 files"
    assert MOST_FILES > 1000


# A process that has another, which has 64 MiB and shares them with a third.
HOARDER = """
import os, time
if os.fork():
    os.wait()
hoard = b"x" * (64 << 20)
os.fork()
print("full", flush=True)
time.sleep(60)
"""


def test_memory_is_counted_of_all_processes_and_what_they_share_once(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-I", "-S", "-c", HOARDER], stdout=subprocess.PIPE) as guard:
        try:
            assert guard.stdout is not None
            assert [guard.stdout.readline() for _ in range(2)] == [b"full\n"] * 2
            # With an interpreter around them; counted twice they would be 128.
            assert UsageWatch(guard.pid, tmp_path, 120 * MEBIBYTE, MEBIBYTE).excess() is None
            excess = UsageWatch(guard.pid, tmp_path, 60 * MEBIBYTE, MEBIBYTE).excess()
        finally:
            for child in [*descendants_of(guard.pid), guard.pid]:
                os.kill(child, signal.SIGKILL)
    assert excess == "took more than 60 MiB of memory in all its processes"


def test_it_looks_only_now_and_then(tmp_path: Path) -> None:
    looking = watch(tmp_path)
    assert looking.excess() is None
    (tmp_path / "large").write_bytes(bytes(3 * MEBIBYTE))
    assert looking.excess() is None
    time.sleep(0.25)
    assert looking.excess() is not None
