"""The number types the tracer runs in, and kernels: its source instantiated with one of them."""

from __future__ import annotations

import math
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.arithmetics.compilation import image_entry_points, kernel_program
from raytruth.reference_tracer.arithmetics.instantiation import COMPILED_ENTRY_POINTS, ENTRY_POINTS, kernel_source
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping
    from contextlib import AbstractContextManager

    from numpy.typing import NDArray

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.arithmetics.kernel import Kernel


@dataclass(frozen=True)
class Arithmetic:
    """A number type: how to make its numbers, and the functions over them that the source takes from `math`."""

    name: str
    number: Callable[[float], Any]
    """Makes a number of this type from a Python float, exactly or rounded."""
    functions: Mapping[str, Any]
    """Replace what the source imports from `math` or defines itself, by name."""
    compiled: bool = False
    decided_comparisons: bool = False
    """For balls: comparisons are calls, and forms that only rounding calls for are left out."""
    rounded_operations: bool = False
    """Each result of an operation is rounded: by the function `rounded`, or by the factor `roundoff_factor`."""
    in_force: Callable[[], AbstractContextManager[object]] = nullcontext
    """A context at whose precision its numbers are made and computed with: balls have one precision for the whole
    process, floats have their own."""
    guarded_divisions: bool = False
    """A division by zero calls the function `over_zero`, for numbers that raise an error there."""
    operations: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    """In compiled code, what operators do to numbers that are NamedTuples of floats: functions, plain ones with types,
    by the operators' names in Python's module `operator`."""

    def numbers(self, values: NDArray[np.float64]) -> Any:
        """One-dimensional values as numbers of this type: an array for compiled code, else a list, which is quicker.

        Numbers that are tuples are the rows of an array.
        """
        if self.compiled and not self._parts:
            return np.ascontiguousarray(values, dtype=self._dtype)
        numbers = [self.number(value) for value in values.tolist()]
        return np.array(numbers, dtype=self._dtype).reshape(len(numbers), *self._parts) if self.compiled else numbers

    def integers(self, values: NDArray[np.int64]) -> Any:
        """One-dimensional values as integers for kernels: an array for compiled code, else a list, which is quicker."""
        return values if self.compiled else values.tolist()

    def image(self, *shape: int) -> NDArray[Any]:
        """An array of zeros of this shape, which holds results of this number type."""
        return np.zeros((*shape, *self._parts), dtype=self._dtype) if self.compiled else np.zeros(shape, dtype=object)

    @property
    def _dtype(self) -> Any:
        return np.asarray(self.number(0.0)).dtype

    @property
    def _parts(self) -> tuple[int, ...]:
        """Of how many floats a number is in arrays; empty for one that is no tuple."""
        return np.shape(self.number(0.0))


KERNEL_FILE = "<kernel"
"""How the file names of kernels begin that are not compiled: they are in no file."""

MATH = {name: getattr(math, name) for name in ("exp", "floor", "inf", "pi", "sqrt", "tan")}


def over_zero(dividend: float, zero: float) -> float:
    """What IEEE 754 says, and compiled floats give: an infinity of the quotient's sign, or NaN of 0/0 and NaN/0."""
    if dividend == 0.0 or math.isnan(dividend):
        return math.nan
    return math.copysign(math.inf, dividend) * math.copysign(1.0, zero)


FLOAT = Arithmetic("float", float, {**MATH, "over_zero": over_zero}, guarded_divisions=True)
FLOAT64 = Arithmetic("float64", np.float64, MATH, compiled=True)
FLOAT32 = Arithmetic(
    "float32",
    np.float32,
    {**MATH, "inf": np.float32(math.inf), "pi": np.float32(math.pi)},
    compiled=True,
)
INTERPRETED_FLOAT32 = Arithmetic(
    "interpreted float32",
    np.float32,
    {
        "sqrt": np.sqrt,
        "tan": np.tan,
        "exp": np.exp,
        "floor": np.floor,
        "inf": np.float32(math.inf),
        "pi": np.float32(math.pi),
    },
)
"""NumPy's numbers, which round as compiled ones do, for kernels that are used too little to be compiled."""


class Namespace:
    """A kernel: its functions as attributes, in the dictionary where they look for one another, so that setting an
    attribute replaces a function for all.
    """

    def __init__(self, names: dict[str, Any]) -> None:
        self.__dict__ = names


def make_kernel(arithmetic: Arithmetic, features: Collection[str], behaviour: Behaviour = IDEAL) -> Kernel:
    """The tracer for one number type, with these features and no others, and with this behaviour.

    Raises what `kernel_source` raises; ValueError also for a constant with the name of one of the arithmetic's
    functions; TypeError for a list of numbers in a kernel that is compiled, and NotCompilableError for a function in it
    that the compiler does not know.
    """
    taken = behaviour.constants.keys() & arithmetic.functions.keys()
    if taken:
        raise ValueError(f"{arithmetic.name} and {behaviour.name} both say what {min(taken)} is")
    forms = PLAIN_FORMS if arithmetic.decided_comparisons else {}
    source, literals = kernel_source(
        features,
        # A behaviour may replace what has a plain form, too.
        replace(behaviour, functions={**forms, **behaviour.functions}),
        entry_points=COMPILED_ENTRY_POINTS if arithmetic.compiled else ENTRY_POINTS,
        decided_comparisons=arithmetic.decided_comparisons and not arithmetic.compiled,
        rounded_operations=arithmetic.rounded_operations,
        guarded_divisions=arithmetic.guarded_divisions,
    )
    if arithmetic.compiled:
        numbers = {**literals, **{name: float(value) for name, value in behaviour.constants.items()}}
        program = kernel_program(source, numbers, arithmetic, image_entry_points(arithmetic))
        return cast("Kernel", Namespace(program.compiled()))
    names: dict[str, Any] = {"float": arithmetic.number}
    with arithmetic.in_force():
        names.update({name: arithmetic.number(value) for name, value in literals.items()})
    names.update(MATH)
    exec(compile(source, f"{KERNEL_FILE} in {arithmetic.name}>", "exec"), names)
    names.update(arithmetic.functions)
    names.update(behaviour.constants)
    return cast("Kernel", Namespace(names))
