from __future__ import annotations

import sys

import pytest

from raytruth.comparisons.court import witnesses
from raytruth.comparisons.court.exact_hits import truth_of
from raytruth.comparisons.court.hearing import outcome
from raytruth.comparisons.court.questions import Question
from raytruth.comparisons.court.witnesses import hear, statements
from raytruth.comparisons.records.renderings import RendererError

pytestmark = pytest.mark.clause("CRT-3")

TRIANGLES = (
    ((-1.0, -1.0, 0.0), (3.0, -1.0, 0.0), (-1.0, 3.0, 0.0)),
    ((-1.0, -1.0, -2.0), (3.0, -1.0, -2.0), (-1.0, 3.0, -2.0)),
)
RAYS = [
    ((0.25, 0.125, 4.0), (0.0, 0.0, -2.0)),
    ((0.25, 0.125, 4.0), (0.125, 0.25, 2.0)),
    ((0.25, 0.125, -1.0), (0.5, 0.25, -4.0)),
    ((9.0, 1.0, 4.0), (1.0, 2.0, -2.0)),
]
SHAPES = (
    {"triangles": TRIANGLES},
    {"sphere": ((0.0, 0.0, 0.5), 1.0)},
    {"box": ((-1.0, -1.0, -3.0), (1.0, 2.0, -2.0))},
)
UNDISPUTED = tuple(Question.model_validate({"origin": o, "direction": d, **shape}) for shape in SHAPES for o, d in RAYS)


def test_every_witness_is_right_where_nothing_is_disputed() -> None:
    truths = [truth_of(question) for question in UNDISPUTED]
    assert {truth.hit for truth in truths} == {True, False}
    heard = list(statements(UNDISPUTED))
    # Blender comes with one version of Python only.
    assert {each.witness for each in heard if each.error} <= {"blender"}
    for statement in heard:
        for truth, answer in zip(truths, statement.answers, strict=True):
            assert outcome(truth, answer) in {"right", "not asked"}, statement.witness
            if answer is not None and answer.distance is not None:
                assert answer.distance == pytest.approx(truth.distance, rel=1e-5)


@pytest.mark.parametrize(
    ("program", "expected"),
    [
        ("raise SystemExit('no licence')", "no licence"),
        ("import os; os.abort()", "SIGABRT"),
        ("", "answers.json cannot be read"),
        ("open('answers.json', 'w').write('[1')", "answers.json cannot be read"),
        ("open('answers.json', 'w').write('{\"version\": \"1\", \"answers\": [null]}')", "1 answers to 12 questions"),
    ],
)
def test_whatever_a_witness_does_is_told_in_one_sentence(program: str, expected: str) -> None:
    with pytest.raises(RendererError, match=expected) as raised:
        hear([sys.executable, "-c", program], UNDISPUTED)
    assert "\n" not in str(raised.value)


@pytest.fixture
def only_one_that_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(witnesses, "WORKERS", {"broken": ("no_such_worker",)})


@pytest.mark.usefixtures("only_one_that_fails")
def test_the_others_are_heard_where_one_fails() -> None:
    first, *others = statements(UNDISPUTED)
    assert first.error is not None
    assert "no_such_worker" in first.error
    assert others
    assert all(each.error is None for each in others)
