"""What a tracer computes otherwise than the source says: functions in place of the source's own, and what they need."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

Function = Callable[..., Any]


@dataclass(frozen=True)
class Behaviour:
    """Changes of the tracer's source that belong together.

    Its functions are source, too: their text becomes part of the kernel, where it may use all that the source has.
    """

    functions: Mapping[str, Function] = field(default_factory=dict)
    """Functions, each by the name of the source's function that it stands in for; both have the same parameters."""
    helpers: tuple[Function, ...] = ()
    """Further functions that those call, by names that the source does not have."""
    constants: Mapping[str, Any] = field(default_factory=dict)
    """What the functions name but do not define: numbers of the kernel's number type, or lists of them."""
    name: str = "a behaviour"
    """What it is called in messages."""
    around: Mapping[str, Function] = field(default_factory=dict)
    """Functions that stand in for the source's, or for those of `functions`, and may call them: as `inner_NAME`."""

    @property
    def names(self) -> tuple[str, ...]:
        """All names that it gives a meaning: of functions it replaces, of helpers and of constants."""
        return (
            *self.functions,
            *map(inner_name, self.around),
            *(helper.__name__ for helper in self.helpers),
            *self.constants,
        )

    def with_numbers(self, number: Function) -> Behaviour:
        """The behaviour for another number type: `number` converts each constant, and each number of a list."""
        constants = {
            name: [number(single) for single in value] if isinstance(value, list) else number(value)
            for name, value in self.constants.items()
        }
        return replace(self, constants=constants)


def inner_name(name: str) -> str:
    """What a function is called inside of one that is put around it."""
    return f"inner_{name}"


IDEAL = Behaviour(name="the source's own behaviour")
"""No change: what the source says."""


def merged(*behaviours: Behaviour) -> Behaviour:
    """One behaviour that has all changes of several. Raises ValueError if a name is given a meaning twice."""
    owners: dict[str, str] = {}
    for behaviour in behaviours:
        for name in behaviour.names:
            if name in owners:
                raise ValueError(f"{owners[name]} and {behaviour.name} both say what {name} is")
            owners[name] = behaviour.name
    return Behaviour(
        {name: function for behaviour in behaviours for name, function in behaviour.functions.items()},
        tuple(helper for behaviour in behaviours for helper in behaviour.helpers),
        {name: value for behaviour in behaviours for name, value in behaviour.constants.items()},
        " and ".join(behaviour.name for behaviour in behaviours if behaviour.names),
        {name: function for behaviour in behaviours for name, function in behaviour.around.items()},
    )
