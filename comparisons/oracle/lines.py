"""Questions as lines of JSON, and answers as lines of JSON. The lines are untrusted: nothing in them is evaluated."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

from pydantic import TypeAdapter, ValidationError

from raytruth.comparisons.oracle.answer import OracleAnswer
from raytruth.comparisons.oracle.answers import answer_to
from raytruth.comparisons.oracle.questions import QUESTIONS, Question, declaration_of
from raytruth.comparisons.oracle.situations import situation_of
from raytruth.comparisons.renderers.program.declared_model import contradictions
from raytruth.scenes.consistency import inconsistencies, parts_of
from raytruth.scenes.loading import LONGEST_WHOLE_NUMBER
from raytruth.scenes.validation import problems_of
from raytruth.scenes.wording import described, place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import BinaryIO

# A question with sixteen lights, each with all of its digits, takes a twentieth of it.
LONGEST_LINE = 2**16
# As C's %a, Java's Double.toHexString and Python's float.hex write a number; a longer one says no more.
_HEX_FLOAT = re.compile(r"[+-]?0[xX][0-9a-fA-F]{1,20}(\.[0-9a-fA-F]{0,20})?[pP][+-]?[0-9]{1,5}")


class QuestionError(ValueError):
    """A question cannot be answered; `problems` has one sentence for each thing to mend."""

    def __init__(self, problems: list[str]) -> None:
        """Keeps the sentences; the exception's text has one on each line."""
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


def answered_lines(lines: BinaryIO) -> Iterator[tuple[str, bool]]:
    """For each line that is not empty the line of its answer, and whether the question was a good one."""
    for number, line in enumerate(iter(lambda: lines.readline(LONGEST_LINE + 1), b""), start=1):
        is_too_long = len(line) > LONGEST_LINE and not line.endswith(b"\n")
        rest = line
        while is_too_long and rest and not rest.endswith(b"\n"):
            rest = lines.readline(LONGEST_LINE)
        if is_too_long:
            yield _refusal(number, [f"expected at most {LONGEST_LINE} bytes, found more."]), False
        elif line.strip():
            yield _answered(number, line)


def answered(data: object) -> OracleAnswer:
    """The answer to a question that is given as JSON is read. Raises QuestionError with every mistake."""
    return answer_to(checked_question(data))


def checked_question(data: object) -> Question:
    """The question that these keys and values state. Raises QuestionError with every mistake."""
    if not isinstance(data, dict):
        raise QuestionError([f"expected an object in braces, found {described(data)}."])
    ask = data.get("ask")
    if not isinstance(ask, str) or ask not in QUESTIONS:
        found = "no such key" if ask is None else described(ask)
        known = suggestion(ask if isinstance(ask, str) else "", QUESTIONS)
        raise QuestionError([f"ask: expected a key 'ask' with what is asked for, found {found}; {known}"])
    try:
        question = QUESTIONS[ask].model_validate(_with_numbers(data))
        problems = [*inconsistencies(parts_of(situation_of(question).scene))]
        problems += [(place(where), told) for where, told in contradictions(declaration_of(question, "float32"))]
    except ValidationError as error:
        problems = problems_of(error, root=QUESTIONS[ask])
    if problems:
        raise QuestionError([f"{_place(where)}: {told}" for where, told in problems])
    return question


def json_schema() -> dict[str, Any]:
    """The schemas (draft 2020-12) of a question and of an answer."""
    questions: TypeAdapter[Question] = TypeAdapter(Question)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:raytruth:oracle:1",
        "title": "raytruth oracle",
        "question": questions.json_schema(),
        "answer": OracleAnswer.model_json_schema(),
    }


def _answered(number: int, line: bytes) -> tuple[str, bool]:
    data: object = None
    try:
        data = json.loads(line.decode("utf-8"), parse_int=_whole_number)
        found = answered(data).model_dump(mode="json")
    except json.JSONDecodeError as error:
        return _refusal(number, [f"column {error.colno}: expected valid JSON, found a mistake: {error.msg}."]), False
    except UnicodeDecodeError as error:
        return _refusal(number, [f"expected text in UTF-8, found byte {error.start} that is not."]), False
    except RecursionError:
        return _refusal(number, ["expected a question, found brackets nested too deeply for one."]), False
    except QuestionError as error:
        return _refusal(number, list(error.problems), data), False
    return json.dumps({"line": number, **found}), True


def _refusal(number: int, problems: list[str], data: object = None) -> str:
    own = data.get("id") if isinstance(data, dict) else None
    return json.dumps(
        {
            "line": number,
            "id": own if isinstance(own, str | int) else None,
            "error": f"line {number}: {' '.join(problems)}",
        }
    )


def _whole_number(digits: str) -> float:
    """As a float an absurd number is refused at its place, like any other that is too large."""
    return int(digits) if len(digits) <= LONGEST_WHOLE_NUMBER else float(digits)


def _place(where: str) -> str:
    return "the question" if where == "the whole file" else where


def _with_numbers(data: Any) -> Any:
    """The same with each text that is a hexadecimal float replaced by it."""
    if isinstance(data, dict):
        return {key: _with_numbers(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_with_numbers(value) for value in data]
    if isinstance(data, str) and _HEX_FLOAT.fullmatch(data):
        return _float_of(data)
    return data


def _float_of(text: str) -> float:
    try:
        return float.fromhex(text)
    except OverflowError:
        raise QuestionError([f"expected a number that float64 holds, found {quoted(text)}."]) from None
