"""All that the compiled code of a name depends on, as text: what is kept of it is valid as long as that is the same."""

from __future__ import annotations

import inspect
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping


def said(names: Mapping[str, Any]) -> Iterator[str]:
    """A line for each name, and for all that the functions among them name in turn: constants, and functions' texts."""
    seen: set[FunctionType] = set()
    waiting = sorted(names.items())
    while waiting:
        name, value = waiting.pop()
        if not isinstance(value, FunctionType):
            yield f"{name} = {value!r}"
        elif value not in seen:
            seen.add(value)
            yield f"{name}: {inspect.getsource(value)}"
            waiting.extend(sorted(_named_by(value).items(), key=lambda item: item[0]))


def _named_by(function: FunctionType) -> dict[str, Any]:
    """What the names in a function stand for, in its module and in the modules that it names there."""
    mentioned = function.__code__.co_names
    found = {name: function.__globals__[name] for name in mentioned if name in function.__globals__}
    modules = [value for value in found.values() if isinstance(value, ModuleType)]
    inner = {
        f"{module.__name__}.{name}": vars(module)[name]
        for module in modules
        for name in mentioned
        if name in vars(module)
    }
    return {name: value for name, value in (found | inner).items() if not isinstance(value, ModuleType)}
