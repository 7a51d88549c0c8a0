"""The cases of the court: one JSON file each in `cases/`, named as the case."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import AnyHttpUrl, BaseModel, ConfigDict, Field, ValidationError

from raytruth.comparisons.court.questions import Question

FOLDER = Path(__file__).parent / "cases"


class CaseError(ValueError):
    """A case's file is wrong; the message has a line for each mistake."""


class Case(BaseModel):
    """A public dispute about a ray."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    title: str
    sources: Annotated[tuple[AnyHttpUrl, ...], Field(min_length=1)]
    dispute: str
    """What is disputed, in our own words."""
    numbers: Literal["theirs", "ours"]
    """Whether the source states the ray and the shape, rounded to float32 here, or we made both to fit the dispute."""
    question: Question


def all_cases(folder: Path = FOLDER) -> dict[str, Case]:
    """All cases of a folder by name, in the order of their names. Raises CaseError with all mistakes of all files."""
    cases: dict[str, Case] = {}
    mistakes: list[str] = []
    for path in sorted(folder.glob("*.json")):
        try:
            cases[path.stem] = Case.model_validate_json(path.read_bytes())
        except ValidationError as error:
            mistakes += [
                f"{path.name}: {'.'.join(map(str, mistake['loc'])) or 'the file'}: {mistake['msg']}"
                for mistake in error.errors(include_url=False)
            ]
    if mistakes:
        raise CaseError("\n".join(mistakes))
    return cases
