"""Translates pydantic's errors into sentences that a person who wrote a scene file understands."""

from __future__ import annotations

import typing
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from raytruth.scenes.scene import Scene
from raytruth.scenes.wording import described, place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pydantic import ValidationError
    from pydantic_core import ErrorDetails

Location = tuple[str | int, ...]

_EXPECTED = {
    "finite_number": "a finite number",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "string_type": "a text in quotes",
    "string_too_short": "a text that is not empty",
    "tuple_type": "a list in square brackets",
    "dict_type": "an object in braces",
    "model_type": "an object in braces",
    "model_attributes_type": "an object in braces",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than": "a number below {lt:g}",
    "less_than_equal": "a number of at most {le:g}",
    "literal_error": "{expected}",
    "too_long": "a list of {max_length}",
}

# Where a union stands whose tag pydantic puts into the location: after this many steps from the top.
_TAG_POSITION = {"camera": 1, "lights": 2, "objects": 2}


def problems_of(error: ValidationError, prefix: Location = (), root: type[BaseModel] = Scene) -> list[tuple[str, str]]:
    """(place, sentence) for each error; `prefix` is where the validated part stands in the whole, a `root`."""
    problems = []
    for details in error.errors(include_url=False):
        # A list whose items are all wrong is not too short as well.
        if details["type"] == "too_short" and details["input"]:
            continue
        # Loading tells these, also where pydantic lets them pass.
        if details["type"] == "string_unicode":
            continue
        location = prefix + details["loc"]
        problems.append((place(_without_tags(location)), _sentence(details, location, root)))
    return problems


def _sentence(details: ErrorDetails, location: Location, root: type[BaseModel]) -> str:
    kind = details["type"]
    context: dict[str, Any] = details.get("ctx", {})
    found = described(details["input"])
    if kind == "extra_forbidden":
        key = str(location[-1])
        return f"expected no key {quoted(key)} here; {suggestion(key, _known_keys(location[:-1], root))}"
    if kind == "missing":
        what = "one more number" if isinstance(location[-1], int) else "this key"
        return f"expected {what}, found nothing; add it."
    if kind == "too_short":
        return "expected at least one, found none."
    if kind == "value_error":
        told = str(context["error"])
        return told if told.endswith((".", "?")) else f"{told}."
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return _tag_sentence(details["input"], context["discriminator"].strip("'"), location, root)
    expected = "expected " + _EXPECTED[kind].format(**context) if kind in _EXPECTED else details["msg"]
    return f"{expected}, found {found}."


def _tag_sentence(value: object, key: str, location: Location, root: type[BaseModel]) -> str:
    """The sentence on an object whose kind (shape, projection, …) is missing or unknown."""
    tags = _tags_at(location, key, root)
    stated = value.get(key) if isinstance(value, dict) else None
    expected = f"expected a key {quoted(key)} with one of {', '.join(map(quoted, tags))}"
    return f"{expected}, found {'no such key' if stated is None else described(stated)}."


def _without_tags(location: Location) -> Location:
    """The location as it reads in the file: pydantic adds which alternative of a union was tried."""
    tag_position = _TAG_POSITION.get(str(location[0])) if location else None
    return tuple(
        step
        for index, step in enumerate(location)
        if index != tag_position
        and step != "[key]"  # of an object's key, not of its value
        and not (isinstance(step, str) and step.startswith("<") and not (index == 1 and location[0] == "materials"))
    )


def _known_keys(location: Location, root: type[BaseModel]) -> set[str]:
    """The keys that the object at this location (with tags) may have."""
    return {
        key for model in _models_at(location, root) for key in model.model_fields if (model, key) != (Scene, "name")
    }


def _tags_at(location: Location, key: str, root: type[BaseModel]) -> list[str]:
    return sorted(
        tag for model in _models_at(location, root) for tag in typing.get_args(model.model_fields[key].annotation)
    )


def _models_at(location: Location, root: type[BaseModel]) -> set[type[BaseModel]]:
    models = {root}
    for index, step in enumerate(location):
        if isinstance(step, int) or (index == 1 and location[0] == "materials"):
            continue
        inner = {
            found
            for model in models
            if step in model.model_fields
            for found in _models_in(model.model_fields[step].annotation)
        }
        models = inner or {model for model in models if step in _literals_in(model)} or models
    return models


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for argument in typing.get_args(annotation):
        yield from _models_in(argument)


def _literals_in(model: type[BaseModel]) -> set[str]:
    return {tag for field in model.model_fields.values() for tag in typing.get_args(field.annotation)}
