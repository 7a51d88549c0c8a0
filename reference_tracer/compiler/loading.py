"""Machine code in this process: object files linked, and their functions called with Python's numbers and arrays."""

from __future__ import annotations

import ctypes
import functools
import itertools
import sys
import threading
from typing import TYPE_CHECKING, Any

import numpy as np
from llvmlite import binding

from raytruth.reference_tracer.compiler.machine_code import target_machine
from raytruth.reference_tracer.compiler.machine_operations import LIBRARY, LIBRARY_PREFIX
from raytruth.reference_tracer.compiler.questions import STACK_IS_FULL, UNDECIDED, UndecidedError
from raytruth.reference_tracer.compiler.types import Array, Boolean, Float, Integer, Tuple, Type, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

_NUMBERS = itertools.count()
_LINKING = threading.Lock()


def loaded(code: bytes, entry_points: Mapping[str, tuple[Type, ...]]) -> dict[str, Callable[..., None]]:
    """The functions of an object file, by name; each is given with the types of its arguments."""
    with _LINKING:
        library = binding.JITLibraryBuilder().add_object_img(code)
        for name, address in _library_addresses().items():
            library.import_symbol(name, address)
        for name in entry_points:
            library.export_symbol(name)
        linked = library.link(_linker(), f"kernel {next(_NUMBERS)}")
    return {name: _Function(linked, name, kinds) for name, kinds in entry_points.items()}


@functools.cache
def _linker() -> Any:
    target_machine()
    return binding.create_lljit_compiler(use_jit_link=True)


@functools.cache
def _library_addresses() -> dict[str, int]:
    """Where the C library's functions are, by the names that compiled code has for them: the ones that Python calls."""
    library = ctypes.CDLL(None)
    names = [name + suffix for name in LIBRARY for suffix in ("", "f")]
    return {LIBRARY_PREFIX + name: ctypes.cast(getattr(library, name), ctypes.c_void_p).value or 0 for name in names}


class _Function:
    """A compiled function. Python's lock is released while it runs, so that threads may run it side by side."""

    def __init__(self, linked: Any, name: str, kinds: tuple[Type, ...]) -> None:
        self.linked = linked  # the code is there as long as this is
        self.kinds = kinds
        arguments = [kind for each in kinds for kind in _ctypes_of(each)]
        self.function = ctypes.CFUNCTYPE(ctypes.c_int64, *arguments)(linked[name])

    def __call__(self, *arguments: Any) -> None:
        """Run it. Raises TypeError for arguments that it does not take.

        Raises MemoryError where a stack had no room, and UndecidedError where a comparison was undecided, unless the
        function has taken the marks of it.
        """
        passed = [leaf for pair in zip(self.kinds, arguments, strict=True) for leaf in _leaves_of(*pair)]
        _require_subnormal_numbers(sys.float_info.min)
        marks = self.function(*passed)
        if marks & STACK_IS_FULL:
            raise MemoryError("the ray tree is deeper than any scene allows")
        if marks & UNDECIDED:
            raise UndecidedError("a comparison is undecided, and the function has not asked whether")


def _require_subnormal_numbers(smallest_normal: float) -> None:
    """Raise RuntimeError where the processor takes numbers near zero for zero, as another library may have set it."""
    if smallest_normal / 2.0 == 0.0:
        raise RuntimeError("a library in this process has set the processor to flush subnormal numbers to zero")


def _ctypes_of(kind: Type) -> list[Any]:
    if isinstance(kind, Tuple):
        return [leaf for part in kind.parts for leaf in _ctypes_of(part)]
    if isinstance(kind, Array):
        return [ctypes.c_void_p, *[ctypes.c_int64] * (kind.dimensions - 1)]
    if isinstance(kind, Float):
        return [ctypes.c_float if kind.bits == 32 else ctypes.c_double]
    return [{Integer: ctypes.c_int64, Boolean: ctypes.c_bool}[type(kind)]]


def _leaves_of(kind: Type, value: Any) -> Iterator[Any]:
    """What is passed for an argument."""
    if isinstance(kind, Tuple):
        for part, each in zip(kind.parts, value, strict=True):
            yield from _leaves_of(part, each)
    elif isinstance(kind, Array):
        inner = _inner_size(kind.element)
        dimensions = kind.dimensions + (inner is not None)
        if value.dtype != _dtype_of(kind.element) or value.ndim != dimensions or not value.flags.c_contiguous:
            raise TypeError(f"a contiguous {shown(kind)} of {kind.dimensions} dimensions is needed, not {value.dtype}")
        if inner is not None and value.shape[-1] != inner:
            raise TypeError(f"the last dimension holds the {inner} parts of {shown(kind.element)}")
        yield value.ctypes.data
        yield from value.shape[1 : kind.dimensions]
    else:
        yield value


def _inner_size(element: Type) -> int | None:
    """How many numbers an element of an array is, if it is a tuple."""
    return len(element.parts) if isinstance(element, Tuple) else None


def _dtype_of(element: Type) -> Any:
    if isinstance(element, Tuple):
        return _dtype_of(element.parts[0])
    if isinstance(element, Float):
        return np.dtype(f"float{element.bits}")
    return np.dtype(np.int64)
