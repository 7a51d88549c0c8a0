"""What a court asks of a program and what it answers: files that a worker reads and writes in its folder."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, TypeAdapter, model_validator

QUESTIONS_FILE = "questions.json"
ANSWERS_FILE = "answers.json"


def exact_float32(value: Any) -> float:
    """A JSON number or a hexadecimal float in a string, as it is. Raises ValueError unless it is one of float32.

    All programs then start from the same numbers, whether they compute in float32 or in float64.
    """
    try:
        number = float.fromhex(value) if isinstance(value, str) else float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError("expected a number, or a hexadecimal float such as '0x1.8p-3'") from error
    with np.errstate(over="ignore"):  # told below
        nearest = float(np.float32(number)) if math.isfinite(number) else math.nan
    if nearest != number:
        raise ValueError(f"expected a finite number of float32, found {value!r}; the nearest is '{nearest.hex()}'")
    return number


Float32 = Annotated[float, BeforeValidator(exact_float32)]
Point = tuple[Float32, Float32, Float32]


class Question(BaseModel):
    """One ray and one thing that it may meet: triangles, a sphere, or a box with sides along the axes.

    All numbers are exact in float32. The ray starts at `origin`, has any length of direction but 0, and no end.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    origin: Point
    direction: Point
    triangles: Annotated[tuple[tuple[Point, Point, Point], ...], Field(max_length=1000)] = ()
    """Corners of each. A thousand are more than any dispute about one ray needs, and nothing to any program."""
    sphere: tuple[Point, Float32] | None = None
    """Centre and radius."""
    box: tuple[Point, Point] | None = None
    """The least and the greatest corner; a flat box is one, too."""

    @model_validator(mode="after")
    def _holds_together(self) -> Question:
        if sum((bool(self.triangles), self.sphere is not None, self.box is not None)) != 1:
            raise ValueError("expected one of triangles, sphere and box")
        if self.direction == (0.0, 0.0, 0.0):
            raise ValueError("expected a direction that is not 0")
        if self.sphere is not None and not self.sphere[1] > 0.0:
            raise ValueError("expected a sphere of positive radius")
        if self.box is not None and any(low > high for low, high in zip(*self.box, strict=True)):
            raise ValueError("expected the least corner of the box first")
        return self

    @property
    def shape(self) -> str:
        """`triangles`, `sphere` or `box`."""
        return "triangles" if self.triangles else "sphere" if self.sphere is not None else "box"


class Answer(BaseModel):
    """What a program says: whether the ray hits and, where it tells, at which t and which triangle, counted from 0."""

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="strings")

    hit: bool
    distance: float | None = None
    primitive: int | None = None


class Answers(BaseModel):
    """Of one program, in the order of the questions; None where it does not know the shape."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    version: str
    answers: tuple[Answer | None, ...]


MISSED = Answer(hit=False)

_QUESTIONS = TypeAdapter(tuple[Question, ...])


def write_questions(folder: Path, questions: tuple[Question, ...]) -> None:
    """For a worker that runs in this folder."""
    (folder / QUESTIONS_FILE).write_bytes(_QUESTIONS.dump_json(questions))


def read_questions() -> tuple[Question, ...]:
    """Those in the current folder, which is a worker's."""
    return _QUESTIONS.validate_json(Path(QUESTIONS_FILE).read_bytes())


def write_answers(version: str, answers: list[Answer | None]) -> None:
    """Into the current folder, which is a worker's."""
    text = Answers(version=version, answers=tuple(answers)).model_dump_json()
    Path(ANSWERS_FILE).write_text(text, encoding="utf-8")
