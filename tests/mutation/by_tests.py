"""The unit tests as judges of mutants: a mutant is killed if a test of the tracer's physics fails with it.

The tests run in a copy of the project, where the mutant is put in place of its file. To start Python and its libraries
anew for each mutant would take longer than most of the tests: each run is a fork of a process that has these loaded.
"""

from __future__ import annotations

import importlib
import json
import os
import shutil
import signal
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
import pytest

from raytruth.reference_tracer.compiled_truth import EnclosedRows
from tests.rooms import FOLDERS, ROOT

if TYPE_CHECKING:
    from collections.abc import Generator, Sequence

    from raytruth.scenes.scene import Scene
    from tests.mutation.mutants import Mutant

# What the tests of physics import from others, and takes long.
LIBRARIES = (
    "llvmlite.binding",
    "numpy",
    "flint",
    "mpmath",
    "hypothesis.extra.numpy",
    "pydantic",
    "scipy.optimize",
    "OpenImageIO",
)
COPIED = (*FOLDERS, "docs", "tests")
# Tests of the physics; those of arithmetics, of kernels and of what is kept would find little more.
TEST_FOLDERS = ("reference_tracer", "properties", "extremes", "second_opinion")
NOT_ABOUT_PHYSICS = {
    "test_arithmetic.py",
    "test_balls.py",
    "test_bounding_volume_tree.py",
    "test_certification.py",
    "test_certified_image.py",
    "test_compilation.py",
    "test_compiled_balls.py",
    "test_compiled_truth.py",
    "test_dependencies.py",
    "test_double_double_balls.py",
    "test_double_double_powers.py",
    "test_features.py",
    "test_float_ball_comparisons.py",
    "test_float_ball_functions.py",
    "test_float_balls.py",
    "test_instantiation.py",
    "test_linked_arithmetic.py",
    "test_linked_balls.py",
    "test_loading.py",
    "test_machine_operations.py",
    "test_mpmath_arithmetic.py",
    "test_object_files.py",
    "test_overloads.py",
    "test_planted_faults.py",
    "test_rendering.py",
    "test_source_digest.py",
    "test_ties.py",
    "test_textbook_forms.py",
    "test_truth_arithmetic.py",
    "test_typer.py",
}
OPTIONS = (
    *("-x", "-q", "--no-header", "-p", "no:cacheprovider", "-p", "no:xdist"),
    *("-W", "ignore::pytest.PytestAssertRewriteWarning"),  # hypothesis is loaded already
)

# A test that takes twenty times as long as it does without a mutant will not end; two seconds, so that noise and the
# first use of a library do not count.
TIMES_AS_LONG, MORE_SECONDS = 20.0, 2.0
DURATIONS = "durations.json"
LOG_FILE = "log.txt"
OUTCOMES = {0: "survived", 1: "killed", 2: "killed"}
"""By pytest's exit status; 2 where a test file cannot even be imported."""
TOOK_TOO_LONG = 3


def load_libraries() -> None:
    """Into this process, from which all runs of tests are forked."""
    for name in LIBRARIES:
        importlib.import_module(name)


def copy_project(folder: Path) -> None:
    """All that the tests of physics need, into a new folder."""
    for name in COPIED:
        ignored = shutil.ignore_patterns("__pycache__", "*.png")
        shutil.copytree(ROOT / name, folder / name, symlinks=True, ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", folder)


def test_files() -> list[str]:
    """The tests of the tracer's physics, by paths from the project's folder."""
    paths = [path for folder in TEST_FOLDERS for path in sorted((ROOT / "tests" / folder).rglob("test_*.py"))]
    return [path.relative_to(ROOT).as_posix() for path in paths if path.name not in NOT_ABOUT_PHYSICS]


def run_without_mutant(folder: Path, paths: Sequence[str]) -> bool:
    """Whether these tests pass in the copy as it is; what each of them takes is kept there."""
    return _forked(folder, partial(_run_tests, folder, paths, {}, "mutants")) == "survived"


def judge(mutant: Mutant, folder: Path, paths: Sequence[str]) -> str:
    """`killed`, `killed by time` or `survived`, by these tests in a copy of the project, which is then as before.

    First the tests of the mutated file, then all others.
    """
    place = folder / "reference_tracer" / "source" / f"{mutant.file}.py"
    durations = json.loads((folder / DURATIONS).read_text(encoding="utf-8"))
    own = [path for path in paths if Path(path).name == f"test_{mutant.file}.py"]
    original, modified = place.read_bytes(), place.stat().st_mtime
    place.write_text(mutant.source(), encoding="utf-8")
    os.utime(place, (0, 0))  # so that the original's byte code is not taken for the mutant's
    try:
        outcome = _forked(folder, partial(_run_tests, folder, own, durations, "mutants")) if own else "survived"
        if outcome == "survived" and (others := [path for path in paths if path not in own]):
            outcome = _forked(folder, partial(_run_tests, folder, others, durations, "mutants-elsewhere"))
    finally:
        place.write_bytes(original)
        os.utime(place, (modified, modified))
    return outcome


def _forked(folder: Path, run: Any) -> str:
    """What came of a run of tests in a process of its own. Raises RuntimeError if that was no run at all."""
    process = os.fork()
    if process == 0:
        _in_child(folder, run)
    _, status = os.waitpid(process, 0)
    code = os.waitstatus_to_exitcode(status)
    if code == TOOK_TOO_LONG or code < 0:  # a recursion without end may overflow the stack
        return "killed by time" if code == TOOK_TOO_LONG else "killed"
    if code not in OUTCOMES:
        raise RuntimeError(f"pytest ended with {code}: {(folder / 'log.txt').read_text(encoding='utf-8')[-2000:]}")
    return OUTCOMES[code]


def _in_child(folder: Path, run: Any) -> NoReturn:
    with (folder / LOG_FILE).open("w", encoding="utf-8") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
    os.chdir(folder)
    sys.path.insert(0, str(folder))
    for name in [name for name in sys.modules if name.split(".")[0] in COPIED]:
        del sys.modules[name]  # they are those of the project, not of the copy
    os._exit(run())


def _run_tests(folder: Path, paths: Sequence[str], durations: dict[str, float], profile: str) -> int:
    """Pytest's exit status; without durations, those of this run are kept."""
    sys.dont_write_bytecode = bool(durations)
    plugin = _Watch(durations)
    status = int(pytest.main([*OPTIONS, f"--hypothesis-profile={profile}", *paths], plugins=[plugin]))
    if not durations:
        (folder / DURATIONS).write_text(json.dumps(plugin.taken), encoding="utf-8")
    return status


class _NothingProven:
    """In place of the compiled truth."""

    def __init__(self, scene: Scene, _frame: object) -> None:
        self.width = scene.camera.width

    def rows(self, first: int, end: int) -> EnclosedRows:
        shape = (end - first, self.width)
        nothing = np.zeros((*shape, 3))
        return EnclosedRows(nothing, nothing.copy(), np.zeros(shape, dtype=bool))


class _Watch:
    """Sorts the tests, the quickest first, and ends those that do not end by themselves."""

    def __init__(self, durations: dict[str, float]) -> None:
        self.durations = durations
        self.taken: dict[str, float] = {}

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        items.sort(key=lambda item: self.durations.get(item.nodeid, 0.0))

    def pytest_collection_finish(self) -> None:
        """Tests that compile are skipped: other ones run the same source interpreted, and a kernel takes a second.

        For the same reason all truth is Arb's.
        """
        arithmetic = importlib.import_module("raytruth.reference_tracer.arithmetics.arithmetic")
        if certified_image := sys.modules.get("raytruth.reference_tracer.certified_image"):  # of the tests' own
            vars(certified_image)["CompiledTruth"] = _NothingProven
        vars(arithmetic)["kernel_program"] = lambda *_: pytest.skip("not compiled for each mutant")

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item: pytest.Item) -> Generator[None, Any, Any]:
        if self.durations:
            limit = MORE_SECONDS + TIMES_AS_LONG * self.durations.get(item.nodeid, 0.0)
            signal.signal(signal.SIGVTALRM, lambda *_: os._exit(TOOK_TOO_LONG))
            signal.setitimer(signal.ITIMER_VIRTUAL, limit)
        result = yield
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.when == "call":
            self.taken[report.nodeid] = report.duration
