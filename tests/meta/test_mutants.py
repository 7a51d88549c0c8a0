"""What automatic mutants tell of the tests: the committed results are those of this source, and the judges judge."""

from __future__ import annotations

import re
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from typing import TYPE_CHECKING

import pytest

from tests.mutation import by_tests
from tests.mutation.by_matrix import judge_all
from tests.mutation.mutants import PHYSICS, Mutant, digest_of, mutants_of, text_of
from tests.mutation.page import PAGE, block
from tests.mutation.results import read_reasons, read_results, unaccounted

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-7")

LEAST_SCORE = 0.95
RESULTS = read_results()
TESTS_OF_REFLECTION = ["tests/reference_tracer/source/test_reflection.py"]
MIRROR = next(mutant for mutant in mutants_of("reflection") if "-" in mutant.before)


def test_the_results_are_those_of_the_source_as_it_stands() -> None:
    changed = [file for file in PHYSICS if RESULTS.files[file].digest != digest_of(file)]
    assert changed == [], "these files have changed since their mutants were judged: run `make mutants`"
    assert RESULTS.files.keys() == set(PHYSICS)


def test_the_tests_kill_nearly_all_mutants() -> None:
    mutants = sum(of_file.mutants for of_file in RESULTS.files.values())
    killed = sum(of_file.killed_by_tests for of_file in RESULTS.files.values())
    assert mutants == sum(len(mutants_of(file)) for file in PHYSICS)
    assert killed >= LEAST_SCORE * mutants


def test_every_survivor_of_the_tests_is_accounted_for() -> None:
    assert unaccounted(RESULTS, read_reasons()) == []


def test_the_page_tells_the_results() -> None:
    assert block(RESULTS, read_reasons()) in PAGE.read_text(encoding="utf-8")


@pytest.mark.parametrize("file", PHYSICS)
def test_each_mutant_is_one_changed_place_of_a_function_or_constant(file: str) -> None:
    found = mutants_of(file)
    sources = {mutant.source() for mutant in found}
    assert len(sources) == len(found)
    assert text_of(file) not in sources
    for mutant in found:
        assert mutant.before in text_of(file).splitlines()[mutant.line - 1]
        assert not mutant.function or re.search(rf"^def {mutant.function}\(", text_of(file), re.MULTILINE)


@pytest.fixture(scope="module")
def process() -> Iterator[ProcessPoolExecutor]:
    """A process without threads, from which others may be forked."""
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        yield pool


@pytest.fixture(scope="module")
def copy(process: ProcessPoolExecutor, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("project")
    by_tests.copy_project(folder)
    assert process.submit(by_tests.run_without_mutant, folder, TESTS_OF_REFLECTION).result()
    return folder


@pytest.fixture
def judged(process: ProcessPoolExecutor, copy: Path) -> Callable[[str, str], str]:
    def by_tests_of_reflection(before: str, after: str) -> str:
        return process.submit(by_tests.judge, made(before, after), copy, TESTS_OF_REFLECTION).result()

    return by_tests_of_reflection


class _Made(Mutant):
    """A mutant written by hand."""

    def source(self) -> str:
        return text_of(self.file).replace(self.before, self.after)


def made(before: str, after: str) -> Mutant:
    assert before in text_of("reflection")
    return _Made("reflection", "by hand", 0, "mirror_direction", 0, before, after)


BODY = "return along(direction, normal, -2.0 * dot(direction, normal))"


def test_what_changes_nothing_survives_the_tests(judged: Callable[[str, str], str]) -> None:
    assert judged(BODY, BODY.replace("-2.0", "-2.00")) == "survived"


@pytest.mark.parametrize(
    ("after", "outcome"),
    [
        (BODY.replace("-2.0", "-3.0"), "killed"),
        ("return None", "killed"),
        (f"{BODY})", "killed"),  # no Python at all
        ("while True: pass", "killed by time"),
    ],
)
def test_what_is_wrong_is_killed_by_the_tests_and_leaves_the_copy_as_it_was(
    judged: Callable[[str, str], str], copy: Path, after: str, outcome: str
) -> None:
    assert judged(BODY, after) == outcome
    assert (copy / "reference_tracer" / "source" / "reflection.py").read_text(encoding="utf-8") == text_of("reflection")
    assert judged(BODY, BODY) == "survived"


def test_the_matrix_kills_a_mutant_and_leaves_what_changes_nothing(tmp_path: Path) -> None:
    nothing = made(BODY, BODY.replace("-2.0", "-2.00"))
    constant = replace(MIRROR, function="")
    killed, survived, not_planted = judge_all([MIRROR, nothing, constant], tmp_path, ("coloured-mirrors",))
    assert (killed, survived, not_planted) == ("coloured-mirrors", "survived", "not planted")
