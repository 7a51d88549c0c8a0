from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.classes.workers import ClusterError, cluster_workers
from tests.comparisons.classes.small_class import written_assignment, written_submission

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = pytest.mark.clause("CLA-4")

STUDENTS = {
    "ada": "",
    "ben": "raise SystemExit('no picture')",
    "cleo": "os.abort()",
    "dan": "open(sys.argv[2], 'w').write('garbage'); sys.exit()",
}


@contextmanager
def cluster(folder: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """The address of a scheduler, and its two workers, each a process without a nanny that would start it again."""
    file = folder / "scheduler.json"
    options = ["--scheduler-file", str(file)]
    plain = {**os.environ, "DASK_DISTRIBUTED__WORKER__MEMORY__TERMINATE": "false"}
    command = [sys.executable, "-m", "dask"]
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": folder, "env": plain}
    scheduler = subprocess.Popen([*command, "scheduler", *options, "--port", "0", "--no-dashboard"], **quiet)
    worker = [*command, "worker", *options, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
    workers = [subprocess.Popen([*worker, "--name", str(number)], **quiet) for number in range(2)]
    try:
        while not file.exists():
            assert scheduler.poll() is None
            time.sleep(0.05)
        yield json.loads(file.read_text())["address"], workers
    finally:
        for process in (*workers, scheduler):
            process.kill()
            process.wait()


def grade_all(folder: Path, out: str, *options: str) -> subprocess.Popen[str]:
    command = [
        sys.executable,
        "-m",
        "raytruth",
        "grade-all",
        "class",
        "--assignment",
        "one.toml",
        "--out",
        out,
        *options,
    ]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def facts(out: Path) -> list[tuple[object, ...]]:
    rows = json.loads((out / "class.json").read_text())["rows"]
    return [(it["student"], it["status"], it["score"], it["topics"], it["group"], it["reason"]) for it in rows]


def test_a_cluster_gives_the_results_of_one_machine_also_when_a_worker_is_killed_in_the_middle(tmp_path: Path) -> None:
    written_assignment(tmp_path)
    for name, misdeed in STUDENTS.items():
        written_submission(tmp_path / "class" / name, f"time.sleep(0.3); {misdeed}")
    local = grade_all(tmp_path, "local")
    _, told = local.communicate()
    assert local.returncode == 0, told
    with cluster(tmp_path) as (address, workers):
        run = grade_all(tmp_path, "cluster", "--scheduler", address)
        rows = tmp_path / "cluster" / "students"
        while not list(rows.glob("*/row.json")):
            assert run.poll() is None, run.communicate()
            time.sleep(0.02)
        workers[0].send_signal(signal.SIGKILL)
        _, told = run.communicate()
        assert run.returncode == 0, told
        assert workers[0].wait() == -signal.SIGKILL
    assert facts(tmp_path / "cluster") == facts(tmp_path / "local")
    done = re.findall(r"^\d of 4: (\w+):", told, re.MULTILINE)
    assert sorted(done) == sorted(STUDENTS)  # each once


def test_an_address_without_a_scheduler_is_one_sentence() -> None:
    with pytest.raises(ClusterError, match="there is no Dask scheduler at nonsense"), cluster_workers("nonsense"):
        pass
