"""Loads an assignment from a TOML file, by name from those that are ready, or with all of its mistakes at once."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from raytruth.comparisons.grading.allowed_models import model_problems
from raytruth.comparisons.grading.assignment import Assignment
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.renderers.program.declaration_file import DeclarationError, parsed_toml
from raytruth.scenes.loading import SceneError
from raytruth.scenes.validation import problems_of
from raytruth.scenes.wording import place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.validation import Location

READY_FOLDER = Path(__file__).with_name("assignments")
STARTING = "whitted"
"""The ready assignment that others start from: it has every key."""
# More than a person reads at once.
_MOST_TOLD = 100


class AssignmentError(Exception):
    """An assignment cannot be used; `problems` has one sentence for each thing to mend."""

    def __init__(self, problems: list[str]) -> None:
        """Keeps the sentences; the exception's text has one on each line."""
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


def ready_names() -> tuple[str, ...]:
    """The names of the assignments that come with raytruth, sorted."""
    return tuple(sorted(path.stem for path in READY_FOLDER.glob("*.toml")))


def assignment_path(name_or_path: str) -> Path:
    """The file of a ready assignment, or the path that ends in .toml. Raises AssignmentError for an unknown name."""
    if name_or_path.lower().endswith(".toml"):
        return Path(name_or_path)
    names = ready_names()
    if name_or_path not in names:
        told = "expected a ready assignment or the path of a .toml file, found neither"
        raise AssignmentError([f"{quoted(name_or_path)}: {told}; {suggestion(name_or_path, names)}"])
    return READY_FOLDER / f"{name_or_path}.toml"


def load_assignment(path: Path) -> Assignment:
    """The assignment in a TOML file. Raises AssignmentError, which holds a sentence for every mistake of the file."""
    try:
        data = parsed_toml(path, "raytruth grade --init FILE")
    except DeclarationError as error:
        raise AssignmentError(list(error.problems)) from error
    return checked_assignment(data, path)


def checked_assignment(data: dict[str, Any], path: Path) -> Assignment:
    """The assignment that these keys and values state. Raises AssignmentError for all mistakes at once."""
    problems: list[str] = []
    try:
        assignment = Assignment.model_validate(data)
    except ValidationError as error:
        problems += [f"{path}: {where}: {told}" for where, told in problems_of(error, root=Assignment)]
        assignment = Assignment.model_validate(_with_stand_ins(data, [it["loc"] for it in error.errors()]))
    problems += [f"{path}: {place(location)}: {told}" for location, told in _further_problems(assignment)]
    try:
        scenes_of(assignment, path.parent)
    except SceneError as error:
        problems += [f"{path}: topics: {told}" for told in error.problems]
    if problems:
        more = [f"{path}: {len(problems) - _MOST_TOLD} more mistakes like these were found."]
        raise AssignmentError(problems[:_MOST_TOLD] + (more if len(problems) > _MOST_TOLD else []))
    return assignment


def _with_stand_ins(data: dict[str, Any], wrong: list[Location]) -> dict[str, Any]:
    """The same with something valid in place of each part that is wrong, so that the rest can be checked, too."""
    kept: dict[str, Any] = {"name": "stand-in", "title": "-", "models": [{}], "topics": [_stand_in("topics", 0)]}
    whole = {str(location[0]) for location in wrong if len(location) == 1 or not isinstance(location[1], int)}
    kept |= {key: value for key, value in data.items() if key not in whole}
    for key, number in {(str(location[0]), location[1]) for location in wrong if str(location[0]) not in whole}:
        kept[key] = [_stand_in(key, number) if place == number else part for place, part in enumerate(kept[key])]
    return kept


def _stand_in(key: str, number: int | str) -> Any:
    """A valid part of one of the lists."""
    return {
        "topics": {"id": f"stand-in-{number}", "title": "-", "scenes": ["single-sphere"]},
        "stages": {"id": f"stand-in-{number}", "without": ["mirrors"]},
        "models": {},
        "feedback": "score",
    }[key]


def json_schema() -> dict[str, Any]:
    """The schema (draft 2020-12) that an assignment obeys; loading checks more than a schema can say."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:raytruth:assignment:1",
        **Assignment.model_json_schema(),
        "title": "raytruth assignment",
    }


def _further_problems(assignment: Assignment) -> Iterator[tuple[Location, str]]:
    """What is wrong with keys that are valid each by itself."""
    for number, model in enumerate(assignment.models):
        for location, told in model_problems(model):
            yield ("models", number, *location), told
    for key, parts in (("topics", assignment.topics), ("stages", assignment.stages)):
        ids = [part.id for part in parts]
        for number, name in enumerate(ids):
            if name in ids[:number]:
                yield (key, number, "id"), f"expected an id of its own, found {quoted(name)} a second time."
    for number, topic in enumerate(assignment.topics):
        if not topic.scenes and not topic.families:
            yield ("topics", number), "expected scenes or families, found neither; without them it has no points."
