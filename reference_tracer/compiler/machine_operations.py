"""The operations that the machine itself has, as LLVM's instructions: IEEE 754, neither contracted nor reordered.

What they give at the edges is what Python gives for floats, or IEEE 754 where Python raises an error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir

from raytruth.reference_tracer.compiler.types import Boolean, Float, Integer, Leaf, Pointer

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

POINTER: Any = ir.PointerType()
INTEGER: Any = ir.IntType(64)
BOOLEAN: Any = ir.IntType(1)
FLOATS: dict[int, Any] = {32: ir.FloatType(), 64: ir.DoubleType()}

INSTRUCTIONS = {"add": "fadd", "sub": "fsub", "mul": "fmul", "truediv": "fdiv", "neg": "fneg"}
LIBRARY = ("exp", "tan", "pow")
"""Functions of the C library; `expf` and the like are those of float32."""
# LLVM knows pow by its name and would replace some of its uses by what rounds otherwise; it knows nothing of these.
LIBRARY_PREFIX = "library_"
SYMBOLS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}
# The first whole number that 64 bits with a sign do not hold; a float.
TOO_LARGE = 2.0**63


def machine_type(leaf: Leaf) -> Any:
    """LLVM's type of a leaf."""
    if isinstance(leaf, Float):
        return FLOATS[leaf.bits]
    return {Integer: INTEGER, Boolean: BOOLEAN, Pointer: POINTER}[type(leaf)]


def reserved(builder: Any, kind: Any, count: int = 1) -> Any:
    """A pointer to room for so many values on the machine's stack, which the function has until it returns."""
    place = builder.alloca(kind, size=ir.Constant(INTEGER, count))
    place.type = POINTER  # LLVM's pointers have had no types since its version 15, llvmlite's still have
    return place


def operation(builder: Any, name: str, operands: Sequence[Any], kind: Leaf) -> Any:
    """The value of an operation on operands of one type, `kind`."""
    if isinstance(kind, Float):
        return _of_floats(builder, name, operands, kind)
    return _of_integers(builder, name, operands)


def _of_floats(builder: Any, name: str, operands: Sequence[Any], kind: Float) -> Any:
    if name in INSTRUCTIONS:
        return getattr(builder, INSTRUCTIONS[name])(*operands)
    if name in SYMBOLS:  # of NaN nothing holds but that it differs
        compare = builder.fcmp_unordered if name == "ne" else builder.fcmp_ordered
        return compare(SYMBOLS[name], *operands)
    if name in {"max", "min"}:  # Python's: the first of two, unless the second is beyond it
        first, second = operands
        return builder.select(builder.fcmp_ordered(">" if name == "max" else "<", second, first), second, first)
    if name == "isnan":
        return builder.fcmp_unordered("uno", operands[0], operands[0])
    if name in COMPOSED:
        return COMPOSED[name](builder, operands, kind)
    function = _library_function if name in LIBRARY else _intrinsic
    return builder.call(function(builder.module, name, kind, len(operands)), operands)


def _floor(builder: Any, operands: Sequence[Any], kind: Float) -> Any:
    """The whole number below a float; -2^63, which is even as all large floats are, where 64 bits do not hold it."""
    value = operands[0]
    limit = ir.Constant(machine_type(kind), TOO_LARGE)
    fits = builder.fcmp_ordered("<", builder.call(_intrinsic(builder.module, "fabs", kind, 1), [value]), limit)
    whole = builder.fptosi(builder.call(_intrinsic(builder.module, "floor", kind, 1), [value]), INTEGER)
    return builder.select(fits, whole, ir.Constant(INTEGER, -(2**63)))


def _product_error(builder: Any, operands: Sequence[Any], kind: Float) -> Any:
    """What rounding the product loses (exact_errors.py)."""
    product = builder.fmul(*operands)
    return builder.call(_intrinsic(builder.module, "fma", kind, 3), [*operands, builder.fneg(product)])


COMPOSED: dict[str, Callable[[Any, Sequence[Any], Float], Any]] = {"floor": _floor, "product_error": _product_error}
"""What is some instructions of the machine."""


def _of_integers(builder: Any, name: str, operands: Sequence[Any]) -> Any:
    if name in SYMBOLS:
        return builder.icmp_signed(SYMBOLS[name], *operands)
    if name in {"max", "min"}:
        first, second = operands
        return builder.select(builder.icmp_signed(">" if name == "max" else "<", second, first), second, first)
    if name in {"mod", "floordiv"}:
        return _divided(builder, name, *operands)
    instruction = {"lshift": "shl", "rshift": "ashr", "not": "not_"}.get(name, name)
    return getattr(builder, instruction)(*operands)


def _divided(builder: Any, name: str, dividend: Any, divisor: Any) -> Any:
    """Python's quotient or rest, which round down; the machine's round to zero. The divisor is positive."""
    rest = builder.srem(dividend, divisor)
    is_below = builder.icmp_signed("<", rest, ir.Constant(INTEGER, 0))
    if name == "mod":
        return builder.select(is_below, builder.add(rest, divisor), rest)
    return builder.sub(builder.sdiv(dividend, divisor), builder.zext(is_below, INTEGER))


def _library_function(module: Any, name: str, kind: Float, count: int) -> Any:
    function = _declared(module, LIBRARY_PREFIX + name + ("f" if kind.bits == 32 else ""), kind, count)
    function.attributes.add("nounwind")
    function.attributes.add("readnone")
    return function


def _intrinsic(module: Any, name: str, kind: Float, count: int) -> Any:
    """Of LLVM, all of them exactly rounded or exact: sqrt, fabs, floor, copysign, fma."""
    return _declared(module, f"llvm.{name}.f{kind.bits}", kind, count)


def _declared(module: Any, name: str, kind: Float, count: int) -> Any:
    if name in module.globals:
        return module.globals[name]
    number = machine_type(kind)
    return ir.Function(module, ir.FunctionType(number, [number] * count), name)
