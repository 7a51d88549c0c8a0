"""Children that misbehave in every way we know."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from comparisons.isolation import LOG_FILE, run_isolated
from comparisons.renderer import RendererError

GENEROUS_SECONDS = 60.0
MEMORY = 256 << 20  # a Python interpreter needs some 30 MB of address space


def run_python(code: str, folder: Path, *, seconds: float = GENEROUS_SECONDS, output_bytes: int = 1 << 16) -> None:
    command = [sys.executable, "-c", code]
    run_isolated(command, folder, seconds=seconds, memory_bytes=MEMORY, output_bytes=output_bytes, file_bytes=1 << 20)


def failure_of(code: str, folder: Path, *, seconds: float = GENEROUS_SECONDS) -> str:
    with pytest.raises(RendererError) as raised:
        run_python(code, folder, seconds=seconds)
    message = str(raised.value)
    assert "\n" not in message
    return message


def process_is_alive(pid: int) -> bool:
    """Whether it still runs; a zombie whose new parent is slow to reap it has ended."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    with open(f"/proc/{pid}/stat", encoding="utf-8") as status:  # noqa: PTH123 - not a file one has a Path for
        return status.read().rpartition(")")[2].split()[0] != "Z"


def assert_ends(pid: int) -> None:
    """A killed process takes the kernel a moment to remove."""
    deadline = time.monotonic() + GENEROUS_SECONDS
    while process_is_alive(pid):
        assert time.monotonic() < deadline, f"process {pid} is still alive"
        time.sleep(0.01)


def test_output_and_errors_of_a_good_child_are_in_the_log_in_order(tmp_path: Path) -> None:
    run_python("import sys; print('one', flush=True); print('two', file=sys.stderr)", tmp_path)
    assert (tmp_path / LOG_FILE).read_text() == "one\ntwo\n"


def test_the_child_runs_in_its_folder_with_an_empty_standard_input(tmp_path: Path) -> None:
    run_python("import os, sys; assert sys.stdin.read() == ''; open('here', 'w').write(os.getcwd())", tmp_path)
    assert (tmp_path / "here").read_text() == str(tmp_path.resolve())


def test_arguments_reach_the_child_as_they_are(tmp_path: Path) -> None:
    code = "import sys; print(sys.argv[1:])"
    arguments = ["$HOME", "a b", "'", ";exit 3", ""]
    run_isolated([sys.executable, "-c", code, *arguments], tmp_path, seconds=GENEROUS_SECONDS, memory_bytes=MEMORY)
    assert (tmp_path / LOG_FILE).read_text().strip() == str(arguments)


def test_an_exit_status_is_named_with_the_end_of_the_log(tmp_path: Path) -> None:
    message = failure_of("import sys; print('all\\x1b went\\nwell'); sys.exit('until here')", tmp_path)
    assert "exit status 1" in message
    assert message.endswith("all  went / well / until here")


@pytest.mark.parametrize(
    ("code", "name"),
    [
        ("import os; os.abort()", "SIGABRT"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "SIGSEGV"),
        ("import ctypes; ctypes.string_at(0)", "SIGSEGV"),
    ],
)
def test_a_signal_is_named(code: str, name: str, tmp_path: Path) -> None:
    assert name in failure_of(code, tmp_path)


@pytest.mark.parametrize("code", ["import time; time.sleep(600)", "while True: pass"])
def test_a_child_that_hangs_meets_the_time_limit(code: str, tmp_path: Path) -> None:
    assert "time limit of 0.3 s" in failure_of(code, tmp_path, seconds=0.3)


def test_a_child_that_closes_its_output_and_hangs_meets_the_time_limit(tmp_path: Path) -> None:
    code = "import os, time; os.close(1); os.close(2); time.sleep(600)"
    message = failure_of(code, tmp_path, seconds=0.3)
    assert "time limit" in message
    assert message.endswith("it printed nothing")


FORK_A_SLEEPER = """
import os, time
child = os.fork()
if child == 0:
    time.sleep(600)
open("grandchild", "w").write(str(child))
"""


@pytest.mark.parametrize("ending", ["", "os.abort()", "time.sleep(600)"])
def test_a_sleeping_grandchild_neither_delays_the_end_nor_survives_it(ending: str, tmp_path: Path) -> None:
    try:
        run_python(FORK_A_SLEEPER + ending, tmp_path, seconds=GENEROUS_SECONDS if ending != "time.sleep(600)" else 1.0)
    except RendererError:
        assert ending
    assert_ends(int((tmp_path / "grandchild").read_text()))


def children() -> set[str]:
    """Process numbers of this process's children, zombies too."""
    return {number for task in Path("/proc/self/task").iterdir() for number in (task / "children").read_text().split()}


def test_no_zombie_of_ours_remains(tmp_path: Path) -> None:
    # Other tests of this process may have children of their own, such as a browser.
    before = children()
    run_python("", tmp_path)
    assert children() <= before


def test_garbage_without_end_is_cut_off(tmp_path: Path) -> None:
    message = failure_of("import os\nwhile True: os.write(1, b'\\xff\\x00garbage' * 1000)", tmp_path)
    assert "printed more than 65536 bytes" in message
    assert (tmp_path / LOG_FILE).stat().st_size == 65536


def test_a_file_without_end_is_cut_off(tmp_path: Path) -> None:
    message = failure_of("f = open('big', 'wb')\nwhile True: f.write(bytes(1 << 16))", tmp_path)
    assert "SIGXFSZ" in message or "File too large" in message
    assert (tmp_path / "big").stat().st_size <= 1 << 20


def test_memory_without_end_is_refused(tmp_path: Path) -> None:
    message = failure_of("hoard = []\nwhile True: hoard.append(bytearray(1 << 26))", tmp_path)
    assert "MemoryError" in message


def test_a_program_that_does_not_exist_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(RendererError, match=r"exit status 127.*not found"):
        run_isolated([str(tmp_path / "no-such-program")], tmp_path, seconds=GENEROUS_SECONDS, memory_bytes=MEMORY)
