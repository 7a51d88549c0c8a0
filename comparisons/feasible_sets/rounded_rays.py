"""Rays as a renderer may compute them: each stands for all the rays that rounding may make of one.

Two ways to follow them. `PlainRays` are quick: every number is a ball. `LinkedRays` are tight, and some twenty times
slower: numbers know which errors they share, so a bundle of rays keeps its shape from bounce to bounce.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Protocol

from flint import arb

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.feasible_sets.asked_once import RememberedHit, decide_shadows_once
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.balls import MARGIN_BITS, Decisions, ball_arithmetic, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, merged
from raytruth.reference_tracer.arithmetics.linked_arithmetic import linked_arithmetic
from raytruth.reference_tracer.arithmetics.linked_balls import (
    condensed,
    enclose,
    enclosure,
    with_own_symbol,
    work_done,
)
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.source.scene_data import MATERIAL_INDEX, MATERIAL_OUTSIDE_INDEX, rows_of
from raytruth.reference_tracer.source.traversal import NOTHING

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.rendering import PreparedScene
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

    NearestHit = Callable[[SceneData, Any, Any, int], tuple[Any, int]]

Box = tuple[Any, Any, Any]
"""A ball for each channel."""
Ray = tuple[Any, ...]
"""A ray as in reference_tracer/source/ray_tree.py, in balls or linked balls; its weight is always a box."""


class RoundedRays(Protocol):
    """A way to follow rays through one scene. Undecided comparisons ask the decisions.

    Who follows a ray puts the arithmetic of the prepared scene in force.
    """

    prepared: PreparedScene
    decisions: Decisions

    def primary_ray(self, column: int, row: int) -> tuple[Any, Any]:
        """Origin and direction through the centre of a pixel, or any point as near to it as the error model says."""

    def trace(self, ray: Ray) -> tuple[Box, list[Ray]]:
        """What a ray brings by itself, and the rays that go on from its end."""

    def work_done(self) -> int:
        """A measure of all work so far that depends on no clock."""

    def first_hit(self, origin: Any, direction: Any) -> tuple[int, tuple[Any, ...]]:
        """The primitive that a primary ray meets (-1: none), and balls for distance, position and normal."""


class PlainRays:
    """Rays whose numbers are balls, obeying RoundedRays.

    `behaviour` is what the renderer does otherwise besides what its error model says; its constants are balls.
    """

    def __init__(self, scene: Scene, error_model: ErrorModel, behaviour: Behaviour = IDEAL) -> None:
        self.decisions = Decisions()
        self._image_radius = error_model.image_radius
        arithmetic = rounded_ball_arithmetic(error_model.precision_bits, self.decisions)
        with arithmetic.in_force():
            self.prepared = prepare(scene, arithmetic, merged(behaviour_of(error_model, scene), behaviour))
            store_indices(self.prepared, error_model.index_bits)
            kernel = self.prepared.kernel
            kernel.nearest_hit = RememberedHit(kernel.nearest_hit, self.decisions)
            decide_shadows_once(kernel, self.decisions)
            camera = _exact_camera(scene, error_model) or self.prepared
            self._primary_ray = camera.kernel.primary_ray
            self._frame = camera.kernel.camera_frame(camera.data)

    def primary_ray(self, column: int, row: int) -> tuple[Any, Any]:
        """Origin and direction as balls, through the centre of a pixel or near it, as the error model says."""
        x, y = arb(column + 0.5, self._image_radius), arb(row + 0.5, self._image_radius)
        return self._primary_ray(self._frame, x, y)

    def trace(self, ray: Ray) -> tuple[Box, list[Ray]]:
        """What a ray brings by itself, as balls, and the rays that go on from its end."""
        children: list[Ray] = []
        return self.prepared.kernel.trace_ray(self.prepared.data, ray, children), children

    def work_done(self) -> int:
        """Comparisons, of which a bundle's way through boxes, triangles and spheres is made."""
        return self.decisions.comparisons

    def first_hit(self, origin: Any, direction: Any) -> tuple[int, tuple[Any, ...]]:
        """The primitive that a primary ray meets (-1: none), and balls for distance, position and normal."""
        return first_hit(self.prepared, origin, direction)


class LinkedRays:
    """Rays whose numbers are linked balls, obeying RoundedRays; made as PlainRays are."""

    def __init__(self, scene: Scene, error_model: ErrorModel, behaviour: Behaviour = IDEAL) -> None:
        self.decisions = Decisions()
        self._image_radius = error_model.image_radius
        self._exact_rays = PlainRays(scene, error_model) if error_model.rasterisation else None
        arithmetic = linked_arithmetic(error_model.precision_bits, self.decisions)
        with arithmetic.in_force():
            in_balls = merged(behaviour_of(error_model, scene), behaviour)
            self.prepared = prepare(scene, arithmetic, in_balls.with_numbers(arithmetic.functions["ball"]))
            store_indices(self.prepared, error_model.index_bits)
            kernel = self.prepared.kernel
            kernel.nearest_hit = _with_own_error(kernel.nearest_hit)
            decide_shadows_once(kernel, self.decisions)
            frame = kernel.camera_frame(self.prepared.data)
            numbers = iter(condensed([number for vector in frame for number in vector]))
            self._frame = tuple((next(numbers), next(numbers), next(numbers)) for _ in frame)

    def primary_ray(self, column: int, row: int) -> tuple[Any, Any]:
        """Origin and direction as linked balls, through the centre of a pixel or near it, as the error model says."""
        ball = self.prepared.arithmetic.functions["ball"]
        if self._exact_rays is not None:
            origin, direction = self._exact_rays.primary_ray(column, row)
            return tuple(map(ball, origin)), tuple(map(ball, direction))
        x, y = (ball(arb(center + 0.5, self._image_radius)) for center in (column, row))
        origin, direction = self.prepared.kernel.primary_ray(self._frame, x, y)
        return _condensed_ray(origin, direction)

    def trace(self, ray: Ray) -> tuple[Box, list[Ray]]:
        """What a ray brings by itself, as balls, and the rays that go on from its end, in linked balls."""
        kernel, arithmetic = self.prepared.kernel, self.prepared.arithmetic
        origin, direction, weight, *rest = ray
        linked_weight = tuple(arithmetic.functions["ball"](channel) for channel in weight)
        children: list[Ray] = []
        local = kernel.trace_ray(self.prepared.data, (origin, direction, linked_weight, *rest), children)
        enclose([*local, *(number for child in children for vector in child[:3] for number in vector)])
        return _box(local), [(*_condensed_ray(child[0], child[1]), _box(child[2]), *child[3:]) for child in children]

    def work_done(self) -> int:
        """As linked_balls.py counts it: some take a hundred times as long for a comparison as others."""
        return work_done()

    def first_hit(self, origin: Any, direction: Any) -> tuple[int, tuple[Any, ...]]:
        """The primitive that a primary ray meets (-1: none), and balls for distance, position and normal."""
        primitive, values = first_hit(self.prepared, origin, direction)
        return primitive, tuple(enclosure(value) for value in values)


def _exact_camera(scene: Scene, error_model: ErrorModel) -> PreparedScene | None:
    """One whose rays are not rounded, for a rasteriser, which computes none: its places in the window are modelled."""
    if error_model.rasterisation is None:
        return None
    return prepare(scene, ball_arithmetic(error_model.precision_bits + MARGIN_BITS, Decisions()))


def store_indices(prepared: PreparedScene, bits: int | None) -> None:
    """Round the indices of refraction in the tables, as a renderer with so few bits does; None: as all numbers."""
    if bits is None:
        return
    linked = prepared.arithmetic.functions.get("ball")
    exact = prepare(prepared.scene, FLOAT).data.numbers
    for table in (MATERIAL_INDEX, MATERIAL_OUTSIDE_INDEX):
        first = prepared.data.integers[table]
        for place in range(first, first + rows_of(prepared.data, table)):
            mantissa, exponent = math.frexp(exact[place])
            rounded = arb(math.ldexp(round(math.ldexp(mantissa, bits)), exponent - bits))
            prepared.data.numbers[place] = linked(rounded) if linked else rounded


def first_hit(prepared: PreparedScene, origin: Any, direction: Any) -> tuple[int, tuple[Any, ...]]:
    """The primitive that a ray meets first, and seven numbers for distance, position and normal; (-1, ()) for none."""
    kernel, data = prepared.kernel, prepared.data
    distance, primitive = kernel.nearest_hit(data, origin, direction, NOTHING)
    if primitive == NOTHING:
        return NOTHING, ()
    point = kernel.hit_point(data, origin, direction, distance, primitive)
    return primitive, (distance, *point, *kernel.surface_normal(data, primitive, point))


def _with_own_error(nearest_hit: NearestHit) -> NearestHit:
    """The same, with a symbol for what rounding may add to the distance.

    It moves the point that is hit along the ray. So the point's coordinates share it, and a point that is found at a
    grazing angle is known to be much nearer to its surface than any of its coordinates is known.
    """

    def with_own_error(scene: SceneData, origin: Any, direction: Any, left: int) -> tuple[Any, int]:
        distance, primitive = nearest_hit(scene, origin, direction, left)
        return distance if primitive == NOTHING else with_own_symbol(distance), primitive

    return with_own_error


def _condensed_ray(origin: Any, direction: Any) -> tuple[Any, Any]:
    x, y, z, dx, dy, dz = condensed([*origin, *direction])
    return (x, y, z), (dx, dy, dz)


def _box(color: Any) -> Box:
    red, green, blue = (enclosure(channel) for channel in color)
    return red, green, blue
