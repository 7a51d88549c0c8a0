from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from raytruth.comparisons.court.questions import Question

pytestmark = pytest.mark.clause("CRT-2")

BOX = {"origin": [0, 0, 0], "direction": [0, 0, "-0x1p-3"], "box": [[0, 0, 0], [1, 1, 1]]}


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"origin": [0.1, 0, 0]}, "0x1.99999a0000000p-4"),
        ({"origin": ["nine", 0, 0]}, "hexadecimal"),
        ({"origin": [1e300, 0, 0]}, "of float32"),
        ({"origin": ["inf", 0, 0]}, "finite"),
        ({"direction": [0, 0, 0]}, "not 0"),
        ({"sphere": [[0, 0, 0], 1]}, "one of triangles, sphere and box"),
        ({"box": None}, "one of triangles, sphere and box"),
        ({"box": [[1, 0, 0], [0, 1, 1]]}, "least corner"),
        ({"box": None, "sphere": [[0, 0, 0], 0]}, "positive radius"),
    ],
)
def test_a_question_that_cannot_be_asked_is_refused(change: dict[str, Any], expected: str) -> None:
    assert Question.model_validate(BOX).direction == (0.0, 0.0, -0.125)
    with pytest.raises(ValidationError, match=expected):
        Question.model_validate(BOX | change)


def test_a_question_keeps_the_sign_of_zero_when_it_is_passed_on() -> None:
    asked = Question.model_validate(BOX | {"direction": [-0.0, 0, 1]})
    assert str(Question.model_validate_json(asked.model_dump_json()).direction[0]) == "-0.0"
