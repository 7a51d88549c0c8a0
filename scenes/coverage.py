"""Which of all that the scene format can say some scenes say: keys set to more than their default, and alternatives.

What can be said follows from the models' types, so that a key that is added is looked for at once. A saying is written
as in error messages, with [] for any place of a list and * for any name: `lights[].falloff is inverse_square`.
"""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping
from typing import Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from raytruth.scenes.scene import Scene

NOT_SAID = ("name", "purpose")
"""What a scene tells of itself: no renderer sees it."""


def sayings() -> tuple[str, ...]:
    """All that the scene format can say, in its order."""
    return tuple(dict.fromkeys(_of_model(Scene, "")))


def said_by(scene: Scene) -> frozenset[str]:
    """What a scene says of it; of materials only those that an object has, or that are media."""
    used = {shape.material for shape in scene.objects} | {scene.camera.inside}
    used |= {material.dielectric.outside for material in scene.materials.values() if material.dielectric}
    materials = {name: material for name, material in scene.materials.items() if name in used}
    return frozenset(_said_by_model(scene.model_copy(update={"materials": materials}), ""))


def _of_model(model: type[BaseModel], place: str) -> Iterator[str]:
    for key, field in model.model_fields.items():
        if not place and key in NOT_SAID:
            continue
        inside = f"{place}.{key}" if place else key
        if not field.is_required():
            yield inside
        yield from _of_type(field.annotation, inside)


def _of_type(kind: Any, place: str) -> Iterator[str]:
    """What a value of this type can say beyond that it is there."""
    origin, arguments = get_origin(kind), get_args(kind)
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        yield from _of_model(kind, place)
    elif origin is Literal:
        yield from (f"{place} is {value}" for value in arguments) if len(arguments) > 1 else ()
    elif origin in {Union, types.UnionType}:
        several = [alternative for alternative in arguments if alternative is not type(None)]
        for alternative in several:
            if len(several) > 1 and get_origin(_bare(alternative)) is not Literal:
                yield f"{place} is {_name(_bare(alternative))}"
            yield from _of_type(alternative, place)
    elif origin is tuple and arguments[-1] is Ellipsis:
        yield from _of_type(arguments[0], f"{place}[]")
    elif origin is dict:
        yield from _of_type(arguments[1], f"{place}.*")
    elif hasattr(kind, "__metadata__"):
        yield from _of_type(arguments[0], place)


def _said_by_model(part: BaseModel, place: str) -> Iterator[str]:
    for key, field in type(part).model_fields.items():
        if not place and key in NOT_SAID:
            continue
        inside, value = f"{place}.{key}" if place else key, getattr(part, key)
        if not field.is_required() and value != field.get_default(call_default_factory=True):
            yield inside
        yield from _said_by(value, field.annotation, inside)


def _said_by(value: Any, kind: Any, place: str) -> Iterator[str]:
    kind = _bare(kind)
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in {Union, types.UnionType}:
        several = [_bare(alternative) for alternative in arguments if alternative is not type(None)]
        if value is not None:
            taken = next(alternative for alternative in several if _is_of(value, alternative))
            if len(several) > 1 and get_origin(taken) is not Literal:
                yield f"{place} is {_name(taken)}"
            yield from _said_by(value, taken, place)
    elif isinstance(value, BaseModel):
        yield from _said_by_model(value, place)
    elif origin is Literal:
        if len(arguments) > 1:
            yield f"{place} is {value}"
    elif origin is tuple and arguments[-1] is Ellipsis:
        for element in value:
            yield from _said_by(element, arguments[0], f"{place}[]")
    elif isinstance(value, Mapping):
        for element in value.values():
            yield from _said_by(element, arguments[1], f"{place}.*")


def _bare(kind: Any) -> Any:
    """A type without what annotates it."""
    return _bare(get_args(kind)[0]) if hasattr(kind, "__metadata__") else kind


def _is_of(value: Any, kind: Any) -> bool:
    """Whether a value is of this alternative of several."""
    if get_origin(kind) is Literal:
        return value in get_args(kind) if isinstance(value, str) else False
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        return isinstance(value, kind)
    return isinstance(value, get_origin(kind) or kind)


def _name(kind: Any) -> str:
    """What an alternative is called: the text of its key that names it where there is one."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        for field in kind.model_fields.values():
            if get_origin(field.annotation) is Literal and len(get_args(field.annotation)) == 1:
                return str(get_args(field.annotation)[0])
        return kind.__name__
    return "a color" if get_origin(kind) is tuple else str(kind)
