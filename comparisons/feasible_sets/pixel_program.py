"""The compiled evaluator of plain balls: the tracer's source with a renderer's behaviour, and what follows its rays.

One program serves all scenes and all error models of the same functions: what else they differ by is in its state.
"""

from __future__ import annotations

import ast
import inspect
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from raytruth.comparisons.feasible_sets import followed_rays, pixel_entries, ray_sums
from raytruth.comparisons.feasible_sets.counted_comparisons import COMPARISONS
from raytruth.comparisons.feasible_sets.run_time_names import PI, is_short, with_run_time_names
from raytruth.comparisons.feasible_sets.tree_memory import BALL, LIMITS_TYPE, TREE_TYPE
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.compilation import scene_type
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.rounded_float_balls import ROUNDED_FLOAT_BALLS
from raytruth.reference_tracer.arithmetics.scripted_decisions import DECISIONS
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

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
EVALUATOR = (followed_rays, ray_sums, pixel_entries)


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


STATE = Tuple(
    (Float(64), Array(BALL), INTEGERS, INTEGERS, DECISIONS, TREE_TYPE, LIMITS_TYPE, Array(BALL, 2), Array(BALL)),
    State._fields,
    State.__name__,
)


class PixelProgram(NamedTuple):
    """A program's entry points, and what it reads from its state by name."""

    entry_points: Mapping[str, Callable[..., None]]
    numbers: tuple[str, ...]
    lists: tuple[str, ...]
    literals: dict[str, float]
    """Those of the numbers that are literals of the source."""


def pixel_program(behaviour: Behaviour) -> PixelProgram:
    """The program for a behaviour, whatever its constants are. Raises NotCompilableError."""
    lists = tuple(name for name, value in behaviour.constants.items() if isinstance(value, list))
    numbers = tuple(behaviour.constants.keys() - set(lists))
    return _pixel_program(tuple(sorted(behaviour.functions.items())), behaviour.helpers, tuple(sorted(numbers)), lists)


@cache
def _pixel_program(
    functions: tuple[tuple[str, Function], ...],
    helpers: tuple[Function, ...],
    own: tuple[str, ...],
    lists: tuple[str, ...],
) -> PixelProgram:
    behaviour = Behaviour({**PLAIN_FORMS, **dict(functions)}, helpers, dict.fromkeys((*own, *lists)))
    text, literals = kernel_source(None, behaviour, entry_points=ASKED, decided_comparisons=True)
    long = {name: value for name, value in literals.items() if not is_short(value)}
    numbers = (PI, *long, *own)
    text = with_run_time_names(text, numbers, lists, AROUND)
    whole = "\n".join([text, *map(inspect.getsource, EVALUATOR)])
    names = {name: ROUNDED_FLOAT_BALLS.number(value) for name, value in literals.items() if name not in long}
    names |= {**_evaluator_names(whole), **COMPARISONS, **ROUNDED_FLOAT_BALLS.functions, "state": state}
    file = f"<evaluator in {ROUNDED_FLOAT_BALLS.name}>"
    operations = ROUNDED_FLOAT_BALLS.operations
    program = Program(whole, file, names, _entry_points(), operations, STACK_CAPACITY, STATE)
    return PixelProgram(program.compiled(), numbers, lists, long)


def _evaluator_names(text: str) -> dict[str, Any]:
    """What the names in the evaluator's text stand for that the text does not define: functions, constants, classes."""
    nodes = list(ast.walk(ast.parse(text)))
    defined = {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
    defined |= {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    mentioned = {node.id for node in nodes if isinstance(node, ast.Name)} - defined - {"TYPE_CHECKING"}
    known = {name: value for module in EVALUATOR for name, value in vars(module).items()}
    return {name: known[name] for name in sorted(mentioned & known.keys())}


def _entry_points() -> dict[str, tuple[Type, ...]]:
    vector = Tuple((BALL,) * 3)
    start = (scene_type(ROUNDED_FLOAT_BALLS), Tuple((vector,) * 5), Array(INTEGER, 2), INTEGER, Array(BALL, 2))
    return {
        "color_pixels": (*start, Array(BALL, 3), Array(INTEGER, 2)),
        "hit_pixels": (*start, Array(INTEGER, 2), Array(BALL, 3), INTEGERS),
    }
