"""From expressions of the typed tree to LLVM's instructions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from llvmlite import ir

from raytruth.reference_tracer.compiler.machine_operations import BOOLEAN, INTEGER, machine_type, operation, reserved
from raytruth.reference_tracer.compiler.questions import UNDECIDED
from raytruth.reference_tracer.compiler.types import Float, Stack, Tuple, leaves, part_leaves

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.reference_tracer.compiler.typed_tree import (
        Build,
        Call,
        Conditional,
        Constant,
        Element,
        Expression,
        Local,
        Operation,
        Part,
        PartAt,
        Pop,
        Question,
        TypedFunction,
    )

ONE = ir.Constant(INTEGER, 1)


class Functions(Protocol):
    """What an expression asks of the module that it is in."""

    capacity: int

    def function(self, function: TypedFunction) -> Any:
        """The machine's function."""


class ExpressionLowering:
    """Lowers the expressions of one function, at the place where its builder stands."""

    def __init__(
        self, builder: Any, entry: Any, variables: dict[str, list[Any]], marks: Any, functions: Functions
    ) -> None:
        self.builder, self.entry, self.variables = builder, entry, variables
        self.marks, self.functions = marks, functions

    def leaves(self, expression: Expression) -> list[Any]:
        """The leaves of the expression's value."""
        found: list[Any] = getattr(self, f"_{type(expression).__name__.lower()}")(expression)
        return found

    def leaf(self, expression: Expression) -> Any:
        """The one leaf of a value that has no parts."""
        (found,) = self.leaves(expression)
        return found

    def _constant(self, expression: Constant) -> list[Any]:
        (leaf,) = leaves(expression.type)
        value = float(expression.value) if isinstance(leaf, Float) else int(expression.value)
        return [ir.Constant(machine_type(leaf), value)]

    def _local(self, expression: Local) -> list[Any]:
        places = self.variables[expression.name]
        return [
            self.builder.load(place, typ=machine_type(leaf))
            for place, leaf in zip(places, leaves(expression.type), strict=True)
        ]

    def mark(self, mark: int) -> None:
        """Set a mark of the call."""
        marks = self.builder.load(self.marks, typ=INTEGER)
        self.builder.store(self.builder.or_(marks, ir.Constant(INTEGER, mark)), self.marks)

    def _question(self, expression: Question) -> list[Any]:
        if expression.name == "undecided":
            self.mark(UNDECIDED)
            return [ir.Constant(BOOLEAN, 1)]
        marks = self.builder.load(self.marks, typ=INTEGER)
        self.builder.store(ir.Constant(INTEGER, 0), self.marks)
        return [marks]

    def _operation(self, expression: Operation) -> list[Any]:
        first = expression.operands[0]
        operands = [leaf for operand in expression.operands for leaf in self.leaves(operand)]
        if expression.name == "len":
            return [self.builder.load(operands[1], typ=INTEGER)]
        if expression.name == "float":
            (leaf,) = leaves(expression.type)
            return [self.builder.sitofp(operands[0], machine_type(leaf))]
        return [operation(self.builder, expression.name, operands, leaves(first.type)[0])]

    def _call(self, expression: Call) -> list[Any]:
        arguments = [leaf for argument in expression.arguments for leaf in self.leaves(argument)]
        whole = self.builder.call(self.functions.function(expression.function), [self.marks, *arguments])
        return [self.builder.extract_value(whole, place) for place in range(len(leaves(expression.type)))]

    def _build(self, expression: Build) -> list[Any]:
        parts = [leaf for part in expression.parts for leaf in self.leaves(part)]
        if not isinstance(expression.type, Stack):
            return parts
        kinds = [machine_type(leaf) for leaf in leaves(expression.type.element)]
        elements = reserved(self.entry, ir.LiteralStructType(kinds), self.functions.capacity)
        height = reserved(self.entry, INTEGER)
        self._store_parts(elements, kinds, ir.Constant(INTEGER, 0), parts)
        self.builder.store(ONE, height)
        return [elements, height]

    def _part(self, expression: Part) -> list[Any]:
        whole = expression.whole.type
        assert isinstance(whole, Tuple)
        return self.leaves(expression.whole)[part_leaves(whole, expression.place)]

    def _partat(self, expression: PartAt) -> list[Any]:
        """The last part, unless the place is an earlier one: a choice, since what is in registers has no address."""
        whole = expression.whole.type
        assert isinstance(whole, Tuple)
        values, place = self.leaves(expression.whole), self.leaf(expression.place)
        *before, found = [values[part_leaves(whole, number)] for number in range(len(whole.parts))]
        for number, part in enumerate(before):
            is_here = self.builder.icmp_signed("==", place, ir.Constant(INTEGER, number))
            found = [self.builder.select(is_here, *pair) for pair in zip(part, found, strict=True)]
        return found

    def _element(self, expression: Element) -> list[Any]:
        kinds = [machine_type(leaf) for leaf in leaves(expression.type)]
        places = self.element_places(expression.array, expression.places, kinds)
        return [self.builder.load(place, typ=kind) for place, kind in zip(places, kinds, strict=True)]

    def element_places(self, array: Expression, places: Sequence[Expression], kinds: Sequence[Any]) -> list[Any]:
        """Where the leaves of an array's element lie: rows of the first dimension lie one after the other."""
        pointer, *sizes = self.leaves(array)
        place, *others = (self.leaf(each) for each in places)
        for size, other in zip(sizes, others, strict=True):
            place = self.builder.add(self.builder.mul(place, size), other)
        return self._places(pointer, kinds, place)

    def _conditional(self, expression: Conditional) -> list[Any]:
        function = self.builder.function
        if_true, if_false, after = (function.append_basic_block() for _ in range(3))
        self.builder.cbranch(self.leaf(expression.test), if_true, if_false)
        ends = []
        for block, value in ((if_true, expression.if_true), (if_false, expression.if_false)):
            self.builder.position_at_end(block)
            ends.append((self.leaves(value), self.builder.block))
            self.builder.branch(after)
        self.builder.position_at_end(after)
        return [self._joined(ends, place) for place in range(len(ends[0][0]))]

    def _joined(self, ends: Sequence[tuple[list[Any], Any]], place: int) -> Any:
        joined = self.builder.phi(ends[0][0][place].type)
        for values, block in ends:
            joined.add_incoming(values[place], block)
        return joined

    def _pop(self, expression: Pop) -> list[Any]:
        elements, height_place = self.leaves(expression.stack)
        height = self.builder.sub(self.builder.load(height_place, typ=INTEGER), ONE)
        self.builder.store(height, height_place)
        kinds = [machine_type(leaf) for leaf in leaves(expression.type)]
        places = self._places(elements, kinds, height)
        return [self.builder.load(place, typ=kind) for place, kind in zip(places, kinds, strict=True)]

    def store_element(self, elements: Any, place: Any, value: Sequence[Any]) -> None:
        """Put a value at a place of what begins at a pointer."""
        self._store_parts(elements, [leaf.type for leaf in value], place, value)

    def _store_parts(self, elements: Any, kinds: Sequence[Any], place: Any, value: Sequence[Any]) -> None:
        for leaf, where in zip(value, self._places(elements, kinds, place), strict=True):
            self.builder.store(leaf, where)

    def _places(self, pointer: Any, kinds: Sequence[Any], place: Any) -> list[Any]:
        element = ir.LiteralStructType(kinds)
        return [
            self.builder.gep(pointer, [place, ir.Constant(ir.IntType(32), number)], source_etype=element)
            for number in range(len(kinds))
        ]
