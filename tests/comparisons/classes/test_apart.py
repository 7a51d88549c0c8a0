from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from raytruth.comparisons.classes.apart import ApartError, apart, end_all

pytestmark = pytest.mark.clause("CLA-2")


def test_a_function_is_called_in_a_process_of_its_own_and_what_it_prints_spoils_nothing() -> None:
    assert apart(os.getpid) != os.getpid()
    assert apart(print, "noise") is None


def test_a_process_that_fails_or_dies_is_one_error_with_what_it_said_last() -> None:
    with pytest.raises(ApartError, match=r"ended with status 1: .*no such place"):
        apart(Path.read_text, Path("no such place"))
    with pytest.raises(ApartError, match="ended with status -6"):
        apart(os.abort)


def test_all_processes_end_when_they_are_told_to() -> None:
    failures: list[ApartError] = []

    def call() -> None:
        try:
            apart(time.sleep, 3600)
        except ApartError as error:
            failures.append(error)

    thread = threading.Thread(target=call)
    thread.start()
    while thread.is_alive():  # until the process has begun, and is ended
        end_all()
        thread.join(0.05)
    assert len(failures) == 1


def test_a_process_ends_when_the_one_that_waits_for_it_is_killed(tmp_path: Path) -> None:
    code = (
        "import time; from pathlib import Path; from tests.comparisons.classes.test_apart import wait_for_ever;"
        f"from raytruth.comparisons.classes.apart import apart; apart(wait_for_ever, {str(tmp_path / 'pid')!r})"
    )
    process = subprocess.Popen([sys.executable, "-c", code])
    while not (tmp_path / "pid").exists():
        assert process.poll() is None
        time.sleep(0.05)
    process.kill()
    process.wait()
    number = (tmp_path / "pid").read_text()
    while Path(f"/proc/{number}").exists() and "(zombie)" not in Path(f"/proc/{number}/status").read_text():
        time.sleep(0.05)


def wait_for_ever(path: str) -> None:
    """Say who is waiting, and wait."""
    unfinished = Path(f"{path}.unfinished")
    unfinished.write_text(str(os.getpid()))
    unfinished.replace(path)
    time.sleep(3600)
