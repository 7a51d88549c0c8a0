from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING

import pytest

from benchmarks.class_speed import HOSTILE, LIMITS, made_class, written_assignment
from benchmarks.likeness import EXAMPLES, MISTAKES, SOURCES, Variant, kind_of, variants
from raytruth.comparisons.classes.exports import submissions_in
from raytruth.comparisons.grading.assignment_file import load_assignment

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CLA-5")


@pytest.mark.parametrize("language", SOURCES)
@pytest.mark.parametrize("mistake", [it for it in MISTAKES if it != "no mistake"])
def test_each_mistake_alters_one_line_of_each_language(language: str, mistake: str) -> None:
    file, _ = SOURCES[language]
    text = (EXAMPLES / language / file).read_text()
    altered = text
    for old, new in MISTAKES[mistake].items():
        altered = altered.replace(old, new)
    lines = zip(text.splitlines(), altered.splitlines(), strict=True)
    assert sum(one != other for one, other in lines) == 1


def test_pairs_are_told_apart_by_what_they_share() -> None:
    right, wrong = Variant("go", "no mistake"), Variant("rust", "no falloff")
    assert kind_of(right, wrong) == "other mistakes, float64"
    assert kind_of(wrong, Variant("cpp", "no falloff", "float32")) == "no falloff, float32 and float64"
    assert len({it.name for it in variants()}) == len(variants()) == 27


@pytest.mark.clause("BEN-1")
def test_a_synthetic_class_has_the_hostile_submissions_once_and_a_valid_assignment(tmp_path: Path) -> None:
    made_class(tmp_path / "class", 14)
    students = [it.student[4:] for it in submissions_in(tmp_path / "class")]
    assert students[: len(HOSTILE)] == list(HOSTILE)
    assert len(set(students)) == 14
    assignment = load_assignment(written_assignment(tmp_path))
    assert assignment.limits.seconds == tomllib.loads(LIMITS)["limits"]["seconds"]
    assert assignment.build == "sh build.sh"
