"""Cells of the matrix as tests of pytest.

Under pytest-xdist each worker judges the cells that it is given; the results are put together, and the report is
written, by the process that started the workers.
"""

from __future__ import annotations

import re
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.quick_suite import write_quick_suite
from raytruth.comparisons.matrix.results_directory import only_run_in
from raytruth.comparisons.matrix.waivers import WaiverError, load_waivers
from raytruth.comparisons.records.image_files import ImageError
from raytruth.comparisons.records.results import Verdict
from raytruth.errors import UsageError
from raytruth.judged_programs import JudgedPrograms
from raytruth.options import expect_folder, open_scenes
from raytruth.programs import programs_of
from raytruth.reports.wording import evidence, printable
from raytruth.scenes.library import library_names
from raytruth.unforeseen import sentence_and_log

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

    from raytruth.comparisons.records.results import Cell
    from raytruth.judged_programs import Place

NODE = "raytruth"
"""What the ids of all these tests begin with: `raytruth::PROGRAM::INTEGRATOR::SCENE`."""
SCENES = "raytruth_scenes"
"""What the workers of pytest-xdist get the names of the scenes as."""


class CellFailedError(Exception):
    """A cell fails; the message is all that is told of it."""


class CellTest(pytest.Item):
    """A cell: it passes, fails, is skipped or fails as expected, as its verdict says."""

    def __init__(self, *, place: Place, judged: JudgedPrograms, strict: bool, **more: Any) -> None:
        """Of this place of what is judged; where `strict`, what is as declared, not as due, fails."""
        super().__init__(name=place[0], **more)
        self._place = place
        self._judged = judged
        self._strict = strict
        self.add_marker(NODE)

    def runtest(self) -> None:
        """Judge the cell."""
        cell, unmatched = self._judged.judged(self._place)
        self.user_properties += [("verdict", cell.verdict.value), ("reason", printable(cell.reason))]
        if unmatched:
            raise CellFailedError(printable(unmatched[0]))
        if cell.waived is not None:
            pytest.xfail(printable(f"{cell.reason}; waived: {cell.waived.reason} {cell.waived.link}"))
        if cell.verdict in {Verdict.INCOMPARABLE, Verdict.UNAVAILABLE}:
            pytest.skip(printable(f"{cell.verdict}: {cell.reason}"))
        if cell.verdict in {Verdict.FAIL, Verdict.ERROR} or (self._strict and cell.verdict == Verdict.DECLARED):
            raise CellFailedError(_told(cell))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> str:  # noqa: ARG002 - pytest's signature
        """A text without a traceback, which would show code of ours and not the program's."""
        error = excinfo.value
        if isinstance(error, CellFailedError | ImageError | OSError) or not isinstance(error, Exception):
            return str(error)
        return sentence_and_log(error, sys.argv)

    def reportinfo(self) -> tuple[Path, None, str]:
        """Where it is shown to come from: no file, since it has none."""
        return self.config.rootpath / NODE, None, self.nodeid.replace("::", " ", 1)


class CellTests(pytest.Collector):
    """All cells of one integrator of one program."""

    def __init__(self, *, places: list[Place], judged: JudgedPrograms, strict: bool, **more: Any) -> None:
        """Of these places of what is judged."""
        super().__init__(**more)
        self._places = places
        self._judged = judged
        self._strict = strict

    def collect(self) -> Iterator[CellTest]:
        """A test for each place."""
        for place in self._places:
            yield CellTest.from_parent(self, place=place, judged=self._judged, strict=self._strict)


class CellPlugin:
    """What pytest does where a program is given, in the hooks of pytest."""

    judged: JudgedPrograms
    """All that the options name; from the start of the session on."""

    def __init__(self, config: pytest.Config) -> None:
        """For a run with these options, which are not looked at yet: `--help` needs none of what they name."""
        self._is_worker = hasattr(config, "workerinput")
        self._strict: bool = config.getoption("raytruth_strict")
        self._lock = ExitStack()
        self._reports: dict[Place, pytest.TestReport] = {}
        self._last_words: str | None = None

    @pytest.hookimpl(optionalhook=True)
    def pytest_configure_node(self, node: Any) -> None:
        """Name the scenes to a worker of pytest-xdist: their files lie there already."""
        node.workerinput[SCENES] = list(self.judged.scenes)

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionstart(self, session: pytest.Session) -> None:
        """Read what the options name, and keep other runs from writing into the results directory.

        Raises pytest.UsageError with every mistake that there is.
        """
        try:
            self.judged = _judged(session.config)
            if not self._is_worker and not session.config.getoption("collectonly"):
                self._lock.enter_context(only_run_in(self.judged.out))
        except UsageError as error:
            raise pytest.UsageError(str(error).replace("--renderer-", "--raytruth-")) from error
        except OSError as error:
            raise pytest.UsageError(f"--raytruth-out: {error.filename}: {error.strerror}.") from error

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(self, session: pytest.Session, items: list[pytest.Item]) -> None:
        """Add the cells, before options such as `-k` choose among all tests."""
        of_column: dict[tuple[str, str], list[Place]] = {}
        for place in self.judged.places:
            of_column.setdefault(place[1:], []).append(place)
        for (program, integrator), places in of_column.items():
            name = f"{NODE}::{program}::{integrator}"
            more = {"places": places, "judged": self.judged, "strict": self._strict}
            items += CellTests.from_parent(session, name=name, nodeid=name, **more).collect()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
        """Say of a skipped cell which it is, and not where in our code that was found."""
        report = yield
        if isinstance(item, CellTest) and report.skipped and isinstance(report.longrepr, tuple):
            report.longrepr = (str(item.config.rootpath / item.nodeid), None, report.longrepr[2])  # type: ignore[assignment]  # pytest itself has None there for tests without a line
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Remember what was judged, here or in a worker."""
        node, *names = report.nodeid.split("::")
        if node == NODE and report.when == "call":
            program, integrator, scene = names
            self._reports[scene, program, integrator] = report

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self) -> None:
        """Put the results together, and write the report."""
        if self._reports and not self._is_worker:
            try:
                self._last_words = f"Report: {self.judged.write_report(self._reports)}"
            except (UsageError, OSError) as error:
                self._last_words = str(error)
        self._lock.close()

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Say what is as declared, not as due, and where the report is."""
        if self._last_words is None:
            return
        terminalreporter.section(NODE)
        for report in self._reports.values():
            told = dict(report.user_properties)
            if report.passed and told.get("verdict") == Verdict.DECLARED:
                terminalreporter.line(f"{report.nodeid} is as declared, not as due: {told['reason']}")
        terminalreporter.line(printable(self._last_words))


def _judged(config: pytest.Config) -> JudgedPrograms:
    """What the options name. Raises UsageError with every mistake that it has."""
    out = Path(config.getoption("raytruth_out"))
    expect_folder(out)
    commands = map(_named, config.getoption("raytruth_command"))
    programs = programs_of(commands, map(Path, config.getoption("raytruth_file")))
    waivers = config.getoption("raytruth_waivers")
    try:
        known_failures = load_waivers(Path(waivers), programs.values()) if waivers else ()
    except WaiverError as error:
        raise UsageError(str(error)) from error
    scenes = config.getoption("raytruth_scene")
    quick = config.getoption("raytruth_quick")
    if quick and scenes:
        raise UsageError("--raytruth-quick: expected no --raytruth-scene beside it, since it names the scenes itself.")
    given = getattr(config, "workerinput", {}).get(SCENES)
    if given is None:
        given = write_quick_suite(out) if quick else scenes or library_names()
    return JudgedPrograms(programs, open_scenes(given), known_failures, out)


def _named(command: str) -> str:
    """The command with a name before it, as `raytruth run` takes it."""
    return command if re.match(r"[\w-]+=", command) else f"program={command}"


def _told(cell: Cell) -> str:
    """All that is told of a cell that fails."""
    return printable("\n".join([f"{cell.verdict}: {cell.reason}", *evidence(cell), f"Repeat it: {cell.command}"]))
