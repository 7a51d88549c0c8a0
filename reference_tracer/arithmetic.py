"""The number types the tracer runs in, and kernels: its source instantiated with one of them."""

from __future__ import annotations

import hashlib
import importlib.util
import math
import os
import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numba
import numpy as np
from platformdirs import user_cache_path

from reference_tracer.instantiation import COMPILED_ENTRY_POINTS, ENTRY_POINTS, kernel_source

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from numpy.typing import NDArray

Kernel = Any
"""The functions of the tracer's source as attributes."""


@dataclass(frozen=True)
class Arithmetic:
    """A number type: how to make its numbers, and the functions over them that the source takes from `math`."""

    name: str
    number: Callable[[float], Any]
    """From a Python float, exactly or rounded to the type."""
    functions: Mapping[str, Any]
    """Replace what the source imports from `math` or defines itself, by name."""
    compiled: bool = False
    decided_comparisons: bool = False

    def numbers(self, values: NDArray[np.float64]) -> Any:
        """One-dimensional values as numbers of this type: an array for compiled code, else a list, which is quicker."""
        if self.compiled:
            return np.ascontiguousarray(values, dtype=type(self.number(0.0)))
        return [self.number(value) for value in values.tolist()]

    def integers(self, values: NDArray[np.int64]) -> Any:
        """As `numbers`, for integers."""
        return values if self.compiled else values.tolist()

    def image(self, *shape: int) -> NDArray[Any]:
        """An array of zeros for results of this number type."""
        return np.zeros(shape, dtype=type(self.number(0.0)) if self.compiled else object)


MATH = {name: getattr(math, name) for name in ("exp", "floor", "inf", "pi", "sqrt", "tan")}

FLOAT = Arithmetic("float", float, MATH)
FLOAT64 = Arithmetic("float64", np.float64, MATH, compiled=True)
FLOAT32 = Arithmetic(
    "float32",
    np.float32,
    {**MATH, "inf": np.float32(math.inf), "pi": np.float32(math.pi)},
    compiled=True,
)


class Namespace:
    """Functions as attributes, for kernels that are not compiled."""

    def __init__(self, names: dict[str, Any]) -> None:
        self.__dict__ = names


def make_kernel(
    arithmetic: Arithmetic,
    features: Collection[str],
    overrides: Mapping[str, Callable[..., object]] | None = None,
) -> Kernel:
    """The tracer for one number type, with these features and no others, and with some functions overridden."""
    source, literals = kernel_source(
        features,
        overrides,
        entry_points=COMPILED_ENTRY_POINTS if arithmetic.compiled else ENTRY_POINTS,
        decided_comparisons=arithmetic.decided_comparisons,
    )
    if arithmetic.compiled:
        return _compiled_module(_compiled_text(arithmetic, source, literals))
    names: dict[str, Any] = {"float": arithmetic.number}
    names.update({name: arithmetic.number(value) for name, value in literals.items()})
    names.update(MATH)
    exec(compile(source, f"<kernel in {arithmetic.name}>", "exec"), names)
    names.update(arithmetic.functions)
    return Namespace(names)


def _compiled_text(arithmetic: Arithmetic, source: str, literals: dict[str, float]) -> str:
    """The kernel as a file that compiles itself when it is imported."""
    number_type = np.dtype(type(arithmetic.number(0.0))).name
    lines = [
        f'"""A kernel of the tracer in {arithmetic.name}; made from its source, do not edit."""',
        "from math import exp, floor, sqrt, tan",
        "from numba import njit",
        f"from numpy import {number_type}",
        f"float = {number_type}",
        f"inf = {number_type}('inf')",
        f"pi = {number_type}({math.pi!r})",
        *(f"{name} = {number_type}({value!r})" for name, value in sorted(literals.items())),
        # Division by zero gives infinity as in IEEE 754, not an exception; `nogil` lets threads share the rows.
        # Only what Python calls needs a wrapper for it and an entry in the compiler's cache: most of the compile time.
        "options = {'nogil': True, 'error_model': 'numpy', 'forceinline': True, 'no_cfunc_wrapper': True}",
        "compiled = njit(no_cpython_wrapper=True, **options)",
        "entry_point = njit(cache=True, **options)",
        re.sub(r"^def (\w+)", _decorated, source, flags=re.MULTILINE),
    ]
    return "\n".join(lines) + "\n"


def _decorated(definition: re.Match[str]) -> str:
    decorator = "entry_point" if definition[1] in COMPILED_ENTRY_POINTS else "compiled"
    return f"\n@{decorator}\n{definition[0]}"


def cache_folder() -> Path:
    """Where compiled kernels are kept: $RAYTRUTH_CACHE, or the user's cache folder."""
    return Path(os.environ.get("RAYTRUTH_CACHE") or user_cache_path("raytruth"))


def _compiled_module(text: str) -> Kernel:
    """Import the text from a folder of its own, named by its hash.

    The compiler's own cache does not notice a change in a function of another file; with all of a kernel in one file
    whose name depends on all of its text, it need not.
    """
    digest = hashlib.sha256(f"{numba.__version__}\n{np.__version__}\n{text}".encode()).hexdigest()[:16]
    path = cache_folder() / "kernels" / f"kernel_{digest}.py"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile("w", dir=path.parent, suffix=".tmp", delete=False, encoding="utf-8") as file:
            file.write(text)
        Path(file.name).replace(path)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # the compiler finds a recursive function by its module's name
    spec.loader.exec_module(module)
    return module
