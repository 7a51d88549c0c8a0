"""What a fault is, and how one is written down: a function of the tracer gone wrong, or of its finished image."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.reference_tracer.arithmetics.edits import Edit, Function, edited

if TYPE_CHECKING:
    from types import ModuleType

    from raytruth.comparisons.error_models.output_model import OutputModel

Array = NDArray[np.float64]
Finish = Callable[[Array], Array]
"""From the linear values that were computed, shape (height, width, 3), to those that are read from the file."""

# What other formulas than the truth's may lose of float64's 53 bits: Fresnel's equations by cosines and ratios lose ten
# for nearly equal indices, |o-c|² - r² fourteen at a height of 1 above a sphere of radius 100,000.
BITS_FOR_OTHER_FORMULAS = 14
STUDENT = ErrorModel(
    f"float64, of which other formulas than the truth's may lose {BITS_FOR_OTHER_FORMULAS} bits",
    precision_bits=53 - BITS_FOR_OTHER_FORMULAS,
)
"""What the renderer of an honest student declares: no fault hides behind it, and what is right passes."""


@dataclass(frozen=True)
class Subject:
    """A renderer under test: the tracer with some functions replaced, and what it declares of itself."""

    name: str
    words: str
    """One sentence: of a fault, as a student would tell it."""
    overrides: Mapping[str, Function] = field(default_factory=dict)
    finish: Finish | None = None
    numbers: Literal["float64", "float32"] = "float64"
    gives: Literal["image", "first hits"] = "image"
    declares: ErrorModel = STUDENT

    def source(self) -> str:
        """All that makes it what it is, as text."""
        functions = [*self.overrides.values(), *([self.finish] if self.finish else [])]
        texts = [*self.overrides, *(inspect.getsource(function) for function in functions)]
        return "\n".join([self.name, self.numbers, self.gives, repr(self.declares), *texts])


@dataclass(frozen=True)
class Fault(Subject):
    """A renderer that is wrong in one point."""

    clause: str = ""
    """The clause of docs/spec.md that it breaks."""
    hint: str = ""
    """Where to look, without the solution."""
    edits: tuple[Edit, ...] = ()
    """What is wrong in the function, where that is told by edits of it."""
    edited: Function | None = None
    """The function that they are edits of, if it is not the tracer's own."""


def fault(
    clause: str,
    function: str,
    hint: str,
    *edits: Edit,
    of: Function | None = None,
    gives: Literal["image", "first hits"] = "image",
    numbers: Literal["float64", "float32"] = "float64",
) -> Callable[[Function], Fault]:
    """Make a fault; the docstring of the decorated function is the student's sentence.

    The decorated function is the faulty one itself. With edits it is empty: they tell what is wrong in the tracer's
    function, or in another that can stand in for it (`of`). Raises ValueError for an edit that cannot be made.
    """

    def made(body: Function) -> Fault:
        return Fault(
            body.__name__,
            words_of(body),
            {function: stand_in(function, body, edits, of)},
            numbers=numbers,
            gives=gives,
            clause=clause,
            hint=hint,
            edits=edits,
            edited=of,
        )

    return made


def stand_in(function: str, body: Function, edits: tuple[Edit, ...], of: Function | None) -> Function:
    """What replaces the tracer's function: the body, or an edited function. Raises ValueError for both at once."""
    if not edits:
        return body
    if inspect.signature(body).parameters:
        raise ValueError(f"{body.__name__} has both a body and edits, of which only one can stand in for {function}")
    return edited(function, *edits, of=of)


def output_fault(clause: str, hint: str, output: OutputModel | None = None) -> Callable[[Finish], Fault]:
    """Make a fault of a function on the finished image, of a renderer that declares this output."""
    declares = STUDENT if output is None else ErrorModel(STUDENT.description, STUDENT.precision_bits, output=output)

    def made(finish: Finish) -> Fault:
        return Fault(finish.__name__, words_of(finish), {}, finish, declares=declares, clause=clause, hint=hint)

    return made


def subjects_in(modules: tuple[ModuleType, ...]) -> dict[str, Any]:
    """All subjects that these modules define, by name, in their order. Raises ValueError for a name used twice."""
    found: dict[str, Any] = {}
    for module in modules:
        for value in vars(module).values():
            if isinstance(value, Subject):
                if value.name in found:
                    raise ValueError(f"two subjects are called {value.name}")
                found[value.name] = value
    return found


def words_of(function: Function) -> str:
    """The docstring as one line."""
    return " ".join((function.__doc__ or "").split())
