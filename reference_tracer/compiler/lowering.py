"""From typed functions to LLVM's IR: each becomes a function of the machine's, and so does what it calls.

A value is a list of its leaves (types.py). Variables lie on the machine's stack, from where LLVM takes them into
registers. Every function has one parameter more than its source: a pointer to the marks of the call (questions.py), by
which code deep inside tells the caller what has happened.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir

from raytruth.reference_tracer.compiler.lowered_expressions import ExpressionLowering
from raytruth.reference_tracer.compiler.machine_operations import INTEGER, POINTER, machine_type, reserved
from raytruth.reference_tracer.compiler.questions import STACK_IS_FULL
from raytruth.reference_tracer.compiler.types import leaves

if TYPE_CHECKING:
    from raytruth.reference_tracer.compiler.typed_tree import (
        Assign,
        Count,
        Evaluate,
        If,
        Push,
        Return,
        Statement,
        Store,
        TypedFunction,
        While,
    )


def lowered_module(entry_points: list[TypedFunction], capacity: int) -> str:
    """The IR of a module in which these functions can be called from outside; stacks hold `capacity` elements.

    They take their arguments leaf by leaf, return nothing to the source, and to the caller the marks.
    """
    lowering = _ModuleLowering(capacity)
    for entry_point in entry_points:
        lowering.entry_point(entry_point)
    return str(lowering.module)


class _ModuleLowering:
    def __init__(self, capacity: int) -> None:
        self.module: Any = ir.Module()
        self.capacity = capacity
        self.functions: dict[TypedFunction, Any] = {}

    def entry_point(self, function: TypedFunction) -> None:
        lowered = self.function(function)
        parameters = lowered.function_type.args[1:]
        outside: Any = ir.Function(self.module, ir.FunctionType(INTEGER, parameters), function.name)
        builder: Any = ir.IRBuilder(outside.append_basic_block())
        marks = reserved(builder, INTEGER)
        builder.store(ir.Constant(INTEGER, 0), marks)
        builder.call(lowered, [marks, *outside.args])
        builder.ret(builder.load(marks, typ=INTEGER))

    def function(self, function: TypedFunction) -> Any:
        """The machine's function; made once."""
        if function not in self.functions:
            parameters = [machine_type(leaf) for kind in function.parameters.values() for leaf in leaves(kind)]
            returns = [machine_type(leaf) for leaf in leaves(function.returns)]
            machine = ir.LiteralStructType(returns) if returns else ir.VoidType()
            name = f"{function.name}.{len(self.functions)}"  # others may have the same name in the source
            lowered: Any = ir.Function(self.module, ir.FunctionType(machine, [POINTER, *parameters]), name)
            lowered.linkage = "internal"
            lowered.attributes.add("nounwind")
            if not function.is_operation:
                # Passing a scene costs more than most functions do with it: left to LLVM, they are a tenth slower.
                lowered.attributes.add("alwaysinline")
            self.functions[function] = lowered
            _FunctionLowering(self, function, lowered).lower()
        return self.functions[function]


class _FunctionLowering:
    def __init__(self, module: _ModuleLowering, function: TypedFunction, lowered: Any) -> None:
        self.function, self.capacity = function, module.capacity
        self.entry: Any = ir.IRBuilder(lowered.append_basic_block("entry"))
        self.builder: Any = ir.IRBuilder(lowered.append_basic_block("body"))
        self.lowered = lowered
        self.marks = lowered.args[0]
        self.variables = {
            name: [self._variable(machine_type(leaf)) for leaf in leaves(kind)]
            for name, kind in function.variables.items()
        }
        self.expressions = ExpressionLowering(self.builder, self.entry, self.variables, self.marks, module)

    def lower(self) -> None:
        arguments = iter(self.lowered.args[1:])
        for name in self.function.parameters:
            for place in self.variables[name]:
                self.entry.store(next(arguments), place)
        self._block(self.function.body)
        if not self.builder.block.is_terminated:  # behind the last return, or where nothing is returned
            returned = self.lowered.function_type.return_type
            if isinstance(returned, ir.VoidType):
                self.builder.ret_void()
            else:
                self.builder.ret(ir.Constant(returned, None))
        self.entry.branch(self.lowered.basic_blocks[1])

    def _variable(self, kind: Any) -> Any:
        """A place on the machine's stack, with a value that does not depend on what was there before."""
        place = reserved(self.entry, kind)
        self.entry.store(ir.Constant(kind, None), place)
        return place

    def _block(self, statements: tuple[Statement, ...]) -> None:
        for statement in statements:
            if self.builder.block.is_terminated:
                return  # what stands behind a return cannot run
            getattr(self, f"_{type(statement).__name__.lower()}")(statement)

    def _assign(self, statement: Assign) -> None:
        for leaf, place in zip(self.expressions.leaves(statement.value), self.variables[statement.name], strict=True):
            self.builder.store(leaf, place)

    def _store(self, statement: Store) -> None:
        value = self.expressions.leaves(statement.value)
        kinds = [leaf.type for leaf in value]
        places = self.expressions.element_places(statement.array, statement.places, kinds)
        for leaf, place in zip(value, places, strict=True):
            self.builder.store(leaf, place)

    def _push(self, statement: Push) -> None:
        elements, height_place = self.expressions.leaves(statement.stack)
        value = self.expressions.leaves(statement.value)
        height = self.builder.load(height_place, typ=INTEGER)
        has_room = self.builder.icmp_signed("<", height, ir.Constant(INTEGER, self.capacity))
        with self.builder.if_else(has_room) as (if_true, if_false):
            with if_true:
                self.expressions.store_element(elements, height, value)
                self.builder.store(self.builder.add(height, ir.Constant(INTEGER, 1)), height_place)
            with if_false:
                self.expressions.mark(STACK_IS_FULL)

    def _evaluate(self, statement: Evaluate) -> None:
        self.expressions.leaves(statement.value)

    def _return(self, statement: Return) -> None:
        if statement.value is None:
            self.builder.ret_void()
            return
        whole: Any = ir.Constant(self.lowered.function_type.return_type, ir.Undefined)
        for place, leaf in enumerate(self.expressions.leaves(statement.value)):
            whole = self.builder.insert_value(whole, leaf, place)
        self.builder.ret(whole)

    def _if(self, statement: If) -> None:
        test = self.expressions.leaf(statement.test)
        after = self.lowered.append_basic_block()
        blocks = [self.lowered.append_basic_block() for _ in range(2)]
        self.builder.cbranch(test, *blocks)
        for block, statements in zip(blocks, (statement.if_true, statement.if_false), strict=True):
            self.builder.position_at_end(block)
            self._block(statements)
            if not self.builder.block.is_terminated:
                self.builder.branch(after)
        self.builder.position_at_end(after)

    def _while(self, statement: While) -> None:
        test, body, after = (self.lowered.append_basic_block() for _ in range(3))
        self.builder.branch(test)
        self.builder.position_at_end(test)
        self.builder.cbranch(self.expressions.leaf(statement.test), body, after)
        self.builder.position_at_end(body)
        self._block(statement.body)
        if not self.builder.block.is_terminated:
            self.builder.branch(test)
        self.builder.position_at_end(after)

    def _count(self, statement: Count) -> None:
        """The count is kept apart from the variable, which the body may change."""
        first, end = (self.expressions.leaf(limit) for limit in (statement.first, statement.end))
        counter = self._variable(INTEGER)
        self.builder.store(first, counter)
        test, body, after = (self.lowered.append_basic_block() for _ in range(3))
        self.builder.branch(test)
        self.builder.position_at_end(test)
        count = self.builder.load(counter, typ=INTEGER)
        self.builder.cbranch(self.builder.icmp_signed("<", count, end), body, after)
        self.builder.position_at_end(body)
        self.builder.store(count, self.variables[statement.name][0])
        self._block(statement.body)
        if not self.builder.block.is_terminated:
            self.builder.store(self.builder.add(count, ir.Constant(INTEGER, 1)), counter)
            self.builder.branch(test)
        self.builder.position_at_end(after)
