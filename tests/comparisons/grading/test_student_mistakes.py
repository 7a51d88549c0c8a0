from __future__ import annotations

import ast
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.grading.faulty_tracers import single_faults
from raytruth.comparisons.grading.global_mistakes import GLOBAL_MISTAKES
from tests.comparisons.grading.student_mistakes import EXAMPLE, MISTAKES, StudentMistake, write_submission

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-5")


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.name)
def test_each_mistake_alters_the_example_and_leaves_a_program(mistake: StudentMistake, tmp_path: Path) -> None:
    declaration = write_submission((mistake,), tmp_path)
    assert declaration.is_file()
    text = (tmp_path / mistake.file).read_text(encoding="utf-8")
    assert text != (EXAMPLE / mistake.file).read_text(encoding="utf-8")
    ast.parse(text)


def test_what_a_mistake_is_known_as_is_known() -> None:
    known = {tracer.name for tracer in single_faults()} | {mistake.name for mistake in GLOBAL_MISTAKES}
    assert {name for mistake in MISTAKES for name in mistake.known_as} <= known
    assert len({mistake.name for mistake in MISTAKES}) == len(MISTAKES)


def test_a_mistake_that_the_example_has_no_place_for_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="nowhere: found 'no such line' 0 times"):
        write_submission((StudentMistake("nowhere", "no such line", "", ()),), tmp_path)
