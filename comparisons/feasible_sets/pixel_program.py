"""The compiled evaluator of plain balls: the tracer's source with a renderer's behaviour, and what follows its rays.

One program serves all scenes and all error models of the same functions: what else they differ by is in its state.
"""

from __future__ import annotations

import ast
import inspect
from dataclasses import dataclass
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from raytruth.comparisons.feasible_sets import boxes, followed_rays, pixel_entries, ray_sums
from raytruth.comparisons.feasible_sets.counted_comparisons import COMPARISONS
from raytruth.comparisons.feasible_sets.run_time_names import PI, is_short, with_run_time_names
from raytruth.comparisons.feasible_sets.tree_memory import LIMITS_TYPE, tree_type
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.compilation import scene_type
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.scripted_decisions import DECISIONS
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.comparisons.feasible_sets.set_arithmetics import SetArithmetic
    from raytruth.comparisons.feasible_sets.tree_memory import Limits, Tree
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.arithmetics.scripted_decisions import ScriptedDecisions
    from raytruth.reference_tracer.compiler.types import Type
    from raytruth.reference_tracer.source.numbers import Table

INTEGER, INTEGERS = Integer(), Array(Integer())
# A ray, and those that go on from it: a mirror's, and two of a dielectric (source/ray_tree.py).
STACK_CAPACITY = 4
ASKED = ("trace_ray", "nearest_hit", "is_occluded", "hit_point", "surface_normal", "primary_ray")
"""What the evaluator calls of the source."""
AROUND = ("nearest_hit", "is_occluded")
"""What it puts functions of its own around."""
EVALUATOR = (boxes, followed_rays, ray_sums, pixel_entries)


class State(NamedTuple):
    """What the functions of the program share."""

    roundoff: float
    constants: Table
    """Numbers one by one, then lists of numbers one after the other."""
    starts: Table
    """Where the lists begin."""
    features: Table
    """1 for those that the scene requires."""
    decisions: ScriptedDecisions
    tree: Tree
    limits: Limits
    rays: Table
    """Six balls for each ray that is kept: origin and direction."""
    remembered: Table
    """How far away the camera ray meets the scene."""


@dataclass(frozen=True, eq=False)
class PixelProgram:
    """A program, and what it reads from its state by name."""

    program: Program
    numbers: tuple[str, ...]
    lists: tuple[str, ...]
    literals: dict[str, float]
    """Those of the numbers that are literals of the source."""

    @cached_property
    def entry_points(self) -> Mapping[str, Callable[..., None]]:
        """What Python calls (pixel_entries.py). Raises NotCompilableError."""
        return self.program.compiled()


def pixel_program(behaviour: Behaviour, balls: SetArithmetic) -> PixelProgram:
    """The program for a behaviour, whatever its constants are, in these balls."""
    lists = tuple(name for name, value in behaviour.constants.items() if isinstance(value, list))
    numbers = tuple(behaviour.constants.keys() - set(lists))
    functions = tuple(sorted(behaviour.functions.items()))
    return _pixel_program(balls, functions, behaviour.helpers, tuple(sorted(numbers)), lists)


@cache
def _pixel_program(
    balls: SetArithmetic,
    functions: tuple[tuple[str, Function], ...],
    helpers: tuple[Function, ...],
    own: tuple[str, ...],
    lists: tuple[str, ...],
) -> PixelProgram:
    behaviour = Behaviour({**PLAIN_FORMS, **dict(functions)}, helpers, dict.fromkeys((*own, *lists)))
    text, literals = kernel_source(None, behaviour, entry_points=ASKED, decided_comparisons=True)
    long = {name: value for name, value in literals.items() if not is_short(value)}
    numbers = (PI, *long, *own)
    whole = "\n".join([with_run_time_names(text, numbers, lists, AROUND), *map(inspect.getsource, EVALUATOR)])
    arithmetic = balls.arithmetic
    names = {name: arithmetic.number(value) for name, value in literals.items() if name not in long}
    names |= {**_evaluator_names(whole), **COMPARISONS, **arithmetic.functions, **balls.names, "state": state}
    file = f"<evaluator in {arithmetic.name}>"
    kinds = _entry_points(balls)
    program = Program(whole, file, names, kinds, arithmetic.operations, STACK_CAPACITY, _state_type(balls.ball))
    return PixelProgram(program, numbers, lists, long)


def _evaluator_names(text: str) -> dict[str, Any]:
    """What the names in the evaluator's text stand for that the text does not define: functions, constants, classes."""
    nodes = list(ast.walk(ast.parse(text)))
    names = [node for node in nodes if isinstance(node, ast.Name)]
    defined = {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
    defined |= {name.id for name in names if isinstance(name.ctx, ast.Store)}
    mentioned = {name.id for name in names} - defined - {"TYPE_CHECKING"}
    known = {name: value for module in EVALUATOR for name, value in vars(module).items()}
    return {name: known[name] for name in sorted(mentioned & known.keys())}


def _entry_points(balls: SetArithmetic) -> dict[str, tuple[Type, ...]]:
    ball = balls.ball
    frame = Tuple((Tuple((ball,) * 3),) * 5)
    start = (scene_type(balls.arithmetic), frame, Array(INTEGER, 2), INTEGER, Array(ball, 2))
    return {
        "color_pixels": (*start, Array(ball, 3), Array(INTEGER, 2)),
        "hit_pixels": (*start, Array(INTEGER, 2), Array(ball, 3), INTEGERS),
    }


def _state_type(ball: Type) -> Tuple:
    numbers = Array(ball)
    kinds = (Float(64), numbers, INTEGERS, INTEGERS, DECISIONS, tree_type(ball), LIMITS_TYPE, Array(ball, 2), numbers)
    return Tuple(kinds, State._fields, State.__name__)
