"""The tracer compiled over linked numbers on a tape, with a renderer's behaviour: what TapeRays call.

One program serves all scenes and all error models of the same functions: what else they differ by is in its state.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from raytruth.comparisons.feasible_sets.run_time_names import PI, with_run_time_names
from raytruth.reference_tracer.arithmetics import (
    linked_steps,
    linked_tape,
    linked_tape_rows,
    linked_tape_sweeps,
    scripted_decisions,
)
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from raytruth.reference_tracer.arithmetics.compilation import scene_type
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.linked_tape import LinkedNumber
from raytruth.reference_tracer.arithmetics.linked_tape_arithmetic import TapeConstants, linked_tape_arithmetic
from raytruth.reference_tracer.arithmetics.linked_tape_memory import BALL, tape_type
from raytruth.reference_tracer.arithmetics.scripted_decisions import DECISIONS, ScriptedDecisions
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.arithmetics.linked_tape import LinkedTape
    from raytruth.reference_tracer.compiler.loading import LoadedFunction
    from raytruth.reference_tracer.compiler.types import Type
    from raytruth.reference_tracer.source.numbers import Table

INTEGER, INTEGERS = Integer(), Array(Integer())
FLOAT32_BITS = 24
INFINITY = "inf"


class State(NamedTuple):
    """What the functions of the program share."""

    tape: LinkedTape
    roundoff: float
    decisions: ScriptedDecisions
    constants: Table
    """Numbers one by one, then lists of numbers one after the other."""
    starts: Table
    """Where the lists begin."""
    features: Table
    """1 for those that the scene requires."""


NUMBERS = Array(Tuple((INTEGER,), LinkedNumber._fields, LinkedNumber.__name__))
STATE = Tuple((tape_type(), Float(64), DECISIONS, NUMBERS, INTEGERS, INTEGERS), State._fields, State.__name__)

STEPS = Behaviour(
    helpers=(
        linked_steps.kept_frame,
        linked_steps.kept_vector,
        linked_steps.kept_primary_ray,
        linked_steps.followed_ray,
        linked_steps.first_hit,
    ),
    name="the steps of linked numbers",
    around={
        "nearest_hit": linked_steps.nearest_hit_with_error,
        "is_occluded": linked_steps.occlusion_decided_once,
    },
)
NAMES: dict[str, Any] = {
    function.__name__: function
    for function in (
        linked_tape_sweeps.box_of,
        linked_tape.number_of_ball,
        linked_tape_rows.reset,
        linked_tape_rows.begin_with,
        linked_tape_rows.forget_numbers,
        linked_tape_rows.forget_rays,
        linked_tape_rows.keep_number,
        linked_tape_rows.keep_ray,
        linked_tape_rows.kept_number,
        linked_tape_rows.kept_ray,
        linked_tape_rows.numbers_made,
        linked_tape_rows.hit_with_error,
        scripted_decisions.next_answer,
        scripted_decisions.next_way,
        scripted_decisions.paused,
        scripted_decisions.resume,
    )
} | {"state": state, "FRAME_ROWS": linked_steps.FRAME_ROWS, "MOST_WAYS": scripted_decisions.MOST_WAYS}
# The rays that go on from one, and the one itself.
STACK_CAPACITY = 1 + linked_steps.MOST_CHILDREN


class LinkedProgram(NamedTuple):
    """A program's functions, and what it reads from its state by name."""

    functions: Mapping[str, LoadedFunction]
    numbers: tuple[str, ...]
    lists: tuple[str, ...]
    literals: dict[str, float]
    """Those of the numbers that are literals of the source."""


def linked_program(behaviour: Behaviour) -> LinkedProgram:
    """The functions of linked_steps.py, compiled for all scenes and for whatever the behaviour's constants are.

    Raises NotCompilableError for a behaviour that the compiler does not know.
    """
    lists = sorted(name for name, value in behaviour.constants.items() if isinstance(value, list))
    own = sorted(behaviour.constants.keys() - set(lists))
    functions = tuple(sorted(behaviour.functions.items()))
    return _linked_program(functions, behaviour.helpers, tuple(own), tuple(lists))


@cache
def _linked_program(
    functions: tuple[tuple[str, Function], ...],
    helpers: tuple[Function, ...],
    own: tuple[str, ...],
    lists: tuple[str, ...],
) -> LinkedProgram:
    behaviour = Behaviour({**PLAIN_FORMS, **dict(functions)}, helpers, dict.fromkeys((*own, *lists)))
    arithmetic = linked_tape_arithmetic(TapeConstants(FLOAT32_BITS))  # of which only the operations are compiled
    kinds = _entry_points(arithmetic)
    text, literals = kernel_source(None, merged(behaviour, STEPS), entry_points=tuple(kinds))
    numbers = (PI, INFINITY, *literals, *own)
    program = Program(
        with_run_time_names(text, numbers, lists, ()),
        f"<kernel in {arithmetic.name}>",
        {**NAMES, **arithmetic.functions},
        kinds,
        arithmetic.operations,
        STACK_CAPACITY,
        STATE,
    )
    return LinkedProgram(program.compiled(), numbers, lists, literals)


def _entry_points(arithmetic: Arithmetic) -> dict[str, tuple[Type, ...]]:
    scene, weight = scene_type(arithmetic), Tuple((BALL,) * 3)
    return {
        "kept_frame": (scene,),
        "kept_primary_ray": (INTEGERS, BALL, BALL),
        "followed_ray": (scene, Array(BALL, 2), Array(INTEGER, 2), INTEGER, weight, INTEGER, INTEGER, INTEGER),
        "first_hit": (scene, Array(BALL), INTEGERS, INTEGER),
    }
