"""Rays whose numbers are linked on a tape, in compiled code: as LinkedRays (rounded_rays.py), but much quicker."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from flint import arb

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.feasible_sets.linked_program import INFINITY, State, linked_program
from raytruth.comparisons.feasible_sets.rounded_rays import rounded_indices
from raytruth.comparisons.feasible_sets.run_time_names import FEATURES, PI
from raytruth.reference_tracer.arithmetics.arithmetic import Namespace
from raytruth.reference_tracer.arithmetics.balls import Decisions
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, merged
from raytruth.reference_tracer.arithmetics.float_ball_conversions import from_arb, to_arb
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.linked_steps import MOST_CHILDREN
from raytruth.reference_tracer.arithmetics.linked_tape import IS_FULL, WORK
from raytruth.reference_tracer.arithmetics.linked_tape_arithmetic import TapeConstants, linked_tape_arithmetic
from raytruth.reference_tracer.arithmetics.linked_tape_memory import tape_memory
from raytruth.reference_tracer.arithmetics.scripted_decisions import (
    HAS_LOST,
    POSITION,
    RECORDED,
    decisions_memory,
)
from raytruth.reference_tracer.rendering import PreparedScene
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.reference_tracer.tables import build_tables
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.linked_program import LinkedProgram
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, Ray
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.arithmetics.kernel import Kernel
    from raytruth.scenes.scene import Scene


class TapeIsFullError(Exception):
    """The tape had no room for what a pixel needs."""


class TapeRays:
    """Rays that are kept beside a tape, obeying RoundedRays; made as PlainRays are.

    A ray's origin is in truth where it is kept, its direction None. Raises TapeIsFullError where a pixel does not fit,
    and NotCompilableError for a behaviour that the compiler does not know: both are for LinkedRays.
    """

    def __init__(self, scene: Scene, error_model: ErrorModel, behaviour: Behaviour = IDEAL) -> None:
        self.decisions = Decisions()
        self._image_radius = error_model.image_radius
        bits = error_model.precision_bits
        constants = TapeConstants(bits)
        arithmetic = linked_tape_arithmetic(constants)
        features = required_features(scene)
        with arithmetic.in_force():
            all_of_it = merged(behaviour_of(error_model, scene), behaviour)
            program = linked_program(all_of_it)
            data = build_tables(scene, features, arithmetic)
            self.prepared = PreparedScene(scene, arithmetic, cast("Kernel", Namespace({})), data)
            for place, value in rounded_indices(scene, data, error_model.index_bits):
                constants.balls[data.numbers[place, 0]] = Ball(value, 0.0)
            numbers, starts = _numbers(program, all_of_it, constants)
        required = np.array([name in features for name in FEATURES], dtype=np.int64)
        tape = tape_memory(constants.balls)
        self._state = State(tape, 2.0**-bits, decisions_memory(), numbers, starts, required)
        self._found = np.zeros(1, dtype=np.int64)
        self._hit = np.zeros((7, 2))
        self._boxes = np.zeros((1 + MOST_CHILDREN, 3, 2))
        self._children = np.zeros((1 + MOST_CHILDREN, 4), dtype=np.int64)
        given = {
            "kept_frame": (data,),
            "kept_primary_ray": (self._found,),
            "followed_ray": (data, self._boxes, self._children),
            "first_hit": (data, self._hit, self._found),
        }
        self._calls = {name: program.functions[name].bound(self._state, *first) for name, first in given.items()}
        self._call("kept_frame")

    def primary_ray(self, column: int, row: int) -> tuple[Any, Any]:
        """Through the centre of a pixel or near it, as the error model says; forgets all other rays."""
        x, y = (from_arb(arb(center + 0.5, self._image_radius)) for center in (column, row))
        self._call("kept_primary_ray", x, y)
        return int(self._found[0]), None

    def trace(self, ray: Ray) -> tuple[Box, list[Ray]]:
        """What a ray brings by itself, as balls, and the rays that go on from its end."""
        kept, _, weight, *rest = ray
        weights = tuple(map(from_arb, weight))
        self._call("followed_ray", kept, weights, *rest)
        boxes = [_box(three) for three in self._boxes[: 1 + self._children[0, 0]].tolist()]
        children = self._children[1 : len(boxes)].tolist()
        return boxes[0], [(kept, None, box, *rest) for box, (kept, *rest) in zip(boxes[1:], children, strict=True)]

    def work_done(self) -> int:
        """Numbers made and links swept back."""
        return int(self._state.tape.counts[WORK])

    def first_hit(self, origin: Any, direction: Any) -> tuple[int, tuple[Any, ...]]:  # noqa: ARG002 - where it is kept is said by the origin
        """The primitive that a primary ray meets (-1: none), and balls for distance, position and normal."""
        self._call("first_hit", origin)
        primitive = int(self._found[0])
        return primitive, () if primitive == NOTHING else tuple(to_arb(Ball(*pair)) for pair in self._hit.tolist())

    def _call(self, name: str, *arguments: Any) -> None:
        """Run a function, whose undecided comparisons follow the script and are recorded in it."""
        answers, counts = self._state.decisions
        script = self.decisions.answers
        answers[: len(script)] = script
        counts[POSITION], counts[RECORDED] = 0, len(script)
        self._calls[name](*arguments)
        self.decisions.answers = [answer == 1 for answer in answers[: counts[RECORDED]].tolist()]
        self.decisions.position = int(counts[POSITION])
        if self._state.tape.counts[IS_FULL] or counts[HAS_LOST]:
            counts[HAS_LOST] = 0
            raise TapeIsFullError


def _numbers(
    program: LinkedProgram, behaviour: Behaviour, constants: TapeConstants
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The numbers of the program's state, the lists of numbers behind them, and where these begin."""
    about_one = arb(1, arb(2) ** -constants.precision_bits)
    known = {INFINITY: constants.stored(math.inf), PI: constants.of_arb(arb.pi() * about_one)}
    known |= {name: constants.stored(value) for name, value in program.literals.items()}
    known |= {name: constants.of_arb(behaviour.constants[name]) for name in program.numbers if name not in known}
    numbers = [known[name] for name in program.numbers]
    starts = []
    for name in program.lists:
        starts.append(len(numbers))
        numbers.extend(map(constants.of_arb, behaviour.constants[name]))
    return np.array(numbers, dtype=np.int64), np.array([*starts, 0], dtype=np.int64)


def _box(balls: list[list[float]]) -> Box:
    red, green, blue = (to_arb(Ball(*pair)) for pair in balls)
    return red, green, blue
