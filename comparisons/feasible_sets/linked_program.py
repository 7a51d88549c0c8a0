"""The tracer compiled over linked numbers on a tape, with a renderer's behaviour: what TapeRays call."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from raytruth.reference_tracer.arithmetics import linked_steps, linked_tape, linked_tape_rows, scripted_decisions
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, merged
from raytruth.reference_tracer.arithmetics.compilation import scene_type
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.linked_tape_memory import BALL, tape_type
from raytruth.reference_tracer.arithmetics.scripted_decisions import DECISIONS, ScriptedDecisions
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.names import NotCompilableError
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.linked_tape import LinkedTape
    from raytruth.reference_tracer.arithmetics.linked_tape_arithmetic import TapeConstants
    from raytruth.reference_tracer.compiler.loading import LoadedFunction
    from raytruth.reference_tracer.compiler.types import Type

INTEGER, INTEGERS = Integer(), Array(Integer())


class State(NamedTuple):
    """What the functions of the program share."""

    tape: LinkedTape
    roundoff: float
    decisions: ScriptedDecisions


STATE = Tuple((tape_type(), Float(64), DECISIONS), State._fields, State.__name__)

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
        linked_tape.box_of,
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
} | {"FRAME_ROWS": linked_steps.FRAME_ROWS, "MOST_WAYS": scripted_decisions.MOST_WAYS}
# The rays that go on from one, and the one itself.
STACK_CAPACITY = 1 + linked_steps.MOST_CHILDREN


def linked_program(
    features: Collection[str], behaviour: Behaviour, arithmetic: Arithmetic, constants: TapeConstants
) -> Mapping[str, LoadedFunction]:
    """The functions of linked_steps.py, compiled for scenes with these features.

    Raises NotCompilableError for a behaviour that the compiler does not know.
    """
    lists = [name for name, value in behaviour.constants.items() if isinstance(value, list)]
    if lists:
        raise NotCompilableError(f"{behaviour.name} has a list of numbers: {lists[0]}")
    plain = replace(behaviour, functions={**PLAIN_FORMS, **behaviour.functions})
    kinds = _entry_points(arithmetic)
    source, literals = kernel_source(features, merged(plain, STEPS), entry_points=tuple(kinds))
    names = {
        **{name: constants.stored(value) for name, value in literals.items()},
        **{name: constants.of_arb(value) for name, value in behaviour.constants.items()},
        **NAMES,
        **arithmetic.functions,
    }
    program = Program(
        source, f"<kernel in {arithmetic.name}>", names, kinds, arithmetic.operations, STACK_CAPACITY, STATE
    )
    return program.compiled()


def _entry_points(arithmetic: Arithmetic) -> dict[str, tuple[Type, ...]]:
    scene, weight = scene_type(arithmetic), Tuple((BALL,) * 3)
    return {
        "kept_frame": (scene,),
        "kept_primary_ray": (INTEGERS, BALL, BALL),
        "followed_ray": (scene, Array(BALL, 2), Array(INTEGER, 2), INTEGER, weight, INTEGER, INTEGER, INTEGER),
        "first_hit": (scene, Array(BALL), INTEGERS, INTEGER),
    }
