"""A text of functions as machine code: all passes, one after the other, or what an earlier run has kept of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.compiler.dependencies import said
from raytruth.reference_tracer.compiler.loading import loaded
from raytruth.reference_tracer.compiler.lowering import lowered_module
from raytruth.reference_tracer.compiler.machine_code import object_code, processor
from raytruth.reference_tracer.compiler.names import functions_of_text
from raytruth.reference_tracer.compiler.object_files import kept_object
from raytruth.reference_tracer.compiler.typer import Typer
from raytruth.reference_tracer.storage.source_digest import source_digest

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.compiler.types import Type

ROOM = "reference_tracer/compiler"


@dataclass(frozen=True)
class Program:
    """What is compiled: functions, what else they name, and which of them are called from outside."""

    text: str
    """Functions and whole-number constants, in Python."""
    file: str
    """What the text is called in messages."""
    names: Mapping[str, Any]
    """What the text names without saying what it is: numbers, functions of Python's or of a module."""
    entry_points: Mapping[str, tuple[Type, ...]]
    """Functions of the text by name, with the types of their arguments. They return nothing."""
    operations: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    """What operators do to numbers that are NamedTuples: functions by the operators' names in module `operator`."""
    stack_capacity: int = 1
    """How many elements a list may hold."""

    def ir_text(self) -> str:
        """The program as LLVM's IR, before LLVM has changed anything. Raises NotCompilableError."""
        names, typer = functions_of_text(self.text, self.file, self.names), Typer(self.operations)
        entry_points = [typer.instance(names[name], kinds) for name, kinds in self.entry_points.items()]
        return lowered_module(entry_points, self.stack_capacity)

    def compiled(self) -> dict[str, Callable[..., None]]:
        """The entry points, compiled or as they were kept. Raises NotCompilableError."""
        return loaded(kept_object(self._depends_on(), lambda: object_code(self.ir_text())), self.entry_points)

    def _depends_on(self) -> list[str]:
        """Texts that differ where the object files may."""
        entry_points = [repr(sorted(self.entry_points.items())), str(self.stack_capacity)]
        return [source_digest(ROOM), *processor(), self.text, *entry_points, *said(self.names), *said(self.operations)]
