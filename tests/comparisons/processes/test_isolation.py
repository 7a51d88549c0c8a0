"""Children that misbehave in every way we know."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from raytruth.comparisons.processes.isolation import LOG_FILE, run_isolated
from raytruth.comparisons.records.renderings import RendererError

pytestmark = pytest.mark.clause("REN-1")

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
import os, sys, time
child = os.fork()
if child == 0:
    {escape}
    time.sleep(600)
os.write(1, b"child %d\\n" % child)
"""
ESCAPES = [
    "pass",
    "os.setsid()",
    "os.setsid()\n    if os.fork(): os._exit(0)\n    os.write(1, b'child %d\\n' % os.getpid())",
]


def children_named_in_the_log(folder: Path) -> list[int]:
    return [int(line.split()[1]) for line in (folder / LOG_FILE).read_text().splitlines() if line.startswith("child")]


@pytest.mark.parametrize("escape", ESCAPES, ids=["same session", "own session", "daemon"])
@pytest.mark.parametrize(
    ("ending", "reason"),
    [("", "left 1 process behind"), ("os.abort()", "SIGABRT"), ("time.sleep(600)", "time limit of 2 s")],
)
def test_a_sleeping_grandchild_neither_delays_the_end_nor_survives_it_and_is_a_failure(
    escape: str, ending: str, reason: str, tmp_path: Path
) -> None:
    assert reason in failure_of(FORK_A_SLEEPER.format(escape=escape) + ending, tmp_path, seconds=2.0)
    grandchildren = children_named_in_the_log(tmp_path)
    assert grandchildren
    for grandchild in grandchildren:
        assert_ends(grandchild)


def test_a_grandchild_that_ends_within_the_grace_is_no_failure(tmp_path: Path) -> None:
    run_python("import os, time\nif os.fork() == 0: time.sleep(0.1)", tmp_path)


def test_one_that_kills_its_guard_is_a_failure_and_does_not_survive_it(tmp_path: Path) -> None:
    code = (
        "import os, signal, time; print('child', os.getpid(), flush=True); os.kill(os.getppid(), {}); time.sleep(600)"
    )
    for name in ("signal.SIGKILL", "signal.SIGTERM"):
        assert "ended the process that guards it" in failure_of(code.format(name), tmp_path)
        for child in children_named_in_the_log(tmp_path):
            assert_ends(child)
    assert "time limit" in failure_of(code.format("signal.SIGSTOP"), tmp_path, seconds=0.5)
    for child in children_named_in_the_log(tmp_path):
        assert_ends(child)


def test_nothing_survives_when_we_are_killed(tmp_path: Path) -> None:
    child = "import os, time; os.setsid(); open('half', 'w').write(str(os.getpid())); os.rename('half', 'named'); "
    code = (
        "import pathlib, sys; from raytruth.comparisons.processes.isolation import run_isolated; "
        "run_isolated(sys.argv[2:], pathlib.Path(sys.argv[1]), seconds=60, memory_bytes=1 << 30)"
    )
    grandchild = [sys.executable, "-c", child + "time.sleep(600)"]
    with subprocess.Popen([sys.executable, "-c", code, str(tmp_path), *grandchild]) as caller:
        try:
            deadline = time.monotonic() + GENEROUS_SECONDS
            while not (tmp_path / "named").exists():
                assert time.monotonic() < deadline, "the child has not started"
                time.sleep(0.01)
        finally:
            caller.kill()
    assert_ends(int((tmp_path / "named").read_text()))


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
    folder = tmp_path / "folder"
    folder.mkdir()
    message = failure_of(f"f = open({str(tmp_path / 'big')!r}, 'wb')\nwhile True: f.write(bytes(1 << 16))", folder)
    assert "SIGXFSZ" in message or "File too large" in message
    assert (tmp_path / "big").stat().st_size <= 1 << 20


def test_what_a_failed_child_wrote_is_removed_and_what_was_there_stays(tmp_path: Path) -> None:
    (tmp_path / "input").write_text("mine")
    code = "import os, sys; os.mkdir('deep'); open('deep/half', 'w').write('x'); open('half', 'w'); sys.exit(1)"
    failure_of(code, tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"input", LOG_FILE}


def test_temporary_files_go_and_results_stay(tmp_path: Path) -> None:
    code = "import tempfile; tempfile.mkstemp(); tempfile.mkdtemp(); open('result', 'w'); print(tempfile.gettempdir())"
    run_python(code, tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"result", LOG_FILE}
    assert str(tmp_path) in (tmp_path / LOG_FILE).read_text()


def test_memory_without_end_is_refused(tmp_path: Path) -> None:
    message = failure_of("hoard = []\nwhile True: hoard.append(bytearray(1 << 26))", tmp_path)
    assert "MemoryError" in message


def test_a_program_that_does_not_exist_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(RendererError, match=r"exit status 127.*not found"):
        run_isolated([str(tmp_path / "no-such-program")], tmp_path, seconds=GENEROUS_SECONDS, memory_bytes=MEMORY)


def test_variables_of_the_environment_reach_the_child_beside_ours(tmp_path: Path) -> None:
    code = "import os; assert os.environ['OMP_NUM_THREADS'] == '1'; assert os.environ['PATH']"
    command = [sys.executable, "-c", code]
    environment = {"OMP_NUM_THREADS": "1"}
    run_isolated(command, tmp_path, seconds=GENEROUS_SECONDS, memory_bytes=MEMORY, environment=environment)


@pytest.mark.parametrize(
    "bomb",
    ["while True: os.fork()", "while True:\n    if os.fork(): os._exit(0)\n    os.fork()"],
    ids=["a tree", "whose parents end"],
)
def test_one_that_starts_others_without_end_is_stopped_before_they_fill_the_machine(bomb: str, tmp_path: Path) -> None:
    message = failure_of(f"import os; print('child', os.getpid(), flush=True)\n{bomb}", tmp_path)
    assert "had more than 512 processes at once" in message
    for child in children_named_in_the_log(tmp_path):
        assert_ends(child)
