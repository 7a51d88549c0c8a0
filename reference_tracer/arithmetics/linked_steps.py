"""What a compiled kernel of linked numbers is asked for: one ray of a pixel's tree at a time.

These functions become part of the kernel (behaviour.py), where they may use what the source has. Between two calls a
ray is kept as six rows (linked_tape_rows.py), what the camera's rays share as the first fifteen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.arithmetics.linked_tape import number_of_ball
from raytruth.reference_tracer.arithmetics.linked_tape_rows import (
    begin_with,
    forget_numbers,
    forget_rays,
    hit_with_error,
    keep_number,
    keep_ray,
    kept_number,
    kept_ray,
    numbers_made,
    reset,
)
from raytruth.reference_tracer.arithmetics.linked_tape_sweeps import box_of
from raytruth.reference_tracer.arithmetics.scripted_decisions import (
    MOST_WAYS,
    next_answer,
    next_way,
    paused,
    resume,
)
from raytruth.reference_tracer.source.camera import camera_frame, primary_ray
from raytruth.reference_tracer.source.ray_tree import hit_point, trace_ray
from raytruth.reference_tracer.source.traversal import NOTHING, is_occluded, nearest_hit, surface_normal

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

FRAME_ROWS = 15
"""Five vectors (source/camera.py)."""
MOST_CHILDREN = 3
"""A mirror's, and two of a dielectric (source/ray_tree.py)."""

# In the kernel these are what the functions below are put around.
inner_nearest_hit, inner_is_occluded = nearest_hit, is_occluded


def kept_frame(scene: SceneData) -> None:
    """Keep what the camera's rays share."""
    reset()
    forget_rays(0)
    frame: Any = camera_frame(scene)
    for vector in range(5):
        for coordinate in range(3):
            keep_number(frame[vector][coordinate], 3 * vector + coordinate, FRAME_ROWS)


def kept_vector(row: int) -> Any:
    """Three numbers that were kept one after the other."""
    return kept_number(row), kept_number(row + 1), kept_number(row + 2)


def kept_primary_ray(found: Table, x: Any, y: Any) -> None:
    """Keep the ray through a point of the image, of which two balls are known; give its row. It is the only one."""
    reset()
    forget_rays(FRAME_ROWS)
    begin_with(0)
    frame = (kept_vector(0), kept_vector(3), kept_vector(6), kept_vector(9), kept_vector(12))
    point: Any = (number_of_ball(x), number_of_ball(y))
    origin, direction = primary_ray(frame, point[0], point[1])
    found[0] = keep_ray(origin, direction)


def followed_ray(
    scene: SceneData, boxes: Table, children: Table, row: int, weight: Any, left: int, medium: int, depth: int
) -> None:
    """Trace a kept ray whose weight is three balls.

    `boxes`, of shape (1 + MOST_CHILDREN, 3), gets what it brings by itself, and the weights of the rays that go on;
    `children` gets for each of these its row, what it left, its medium and its depth, and before them their number.
    """
    origin, direction = kept_ray(row)
    linked: Any = (number_of_ball(weight[0]), number_of_ball(weight[1]), number_of_ball(weight[2]))
    waiting: Any = [(origin, direction, linked, left, medium, depth)]
    local: Any = trace_ray(scene, waiting.pop(), waiting)
    for channel in range(3):
        boxes[0, channel] = box_of(local[channel])
    children[0, 0] = len(waiting)
    while len(waiting) > 0:
        place = len(waiting)
        origin, direction, linked, left, medium, depth = waiting.pop()
        for channel in range(3):
            boxes[place, channel] = box_of(linked[channel])
        children[place, 0] = keep_ray(origin, direction)
        children[place, 1] = left
        children[place, 2] = medium
        children[place, 3] = depth


def first_hit(scene: SceneData, boxes: Table, found: Table, row: int) -> None:
    """What a kept ray meets: the primitive, and boxes of distance, position and normal."""
    origin, direction = kept_ray(row)
    hit: Any = nearest_hit(scene, origin, direction, NOTHING)
    distance, primitive = hit
    found[0] = primitive
    if primitive != NOTHING:
        point: Any = hit_point(scene, origin, direction, distance, primitive)
        normal: Any = surface_normal(scene, primitive, point)
        boxes[0] = box_of(distance)
        for coordinate in range(3):
            boxes[1 + coordinate] = box_of(point[coordinate])
            boxes[4 + coordinate] = box_of(normal[coordinate])


def nearest_hit_with_error(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Around `nearest_hit`: with a symbol for what rounding may add to the distance.

    It moves the point that is hit along the ray. So the point's coordinates share it, and a point that is found at a
    grazing angle is known to be much nearer to its surface than any of its coordinates is known.
    """
    hit: Any = inner_nearest_hit(scene, origin, direction, left)
    distance, primitive = hit
    if primitive != NOTHING:
        distance = hit_with_error(distance)
    return distance, primitive


def occlusion_decided_once(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Around `is_occluded`: one decision, however many comparisons it rests on.

    A shadow ray to a corner leaves open, of each triangle there, by which of its edges it may pass: all these ways end
    in light or in shadow. Where they do not all agree, or are too many, both are possible.
    """
    made = numbers_made()
    was = paused()
    light = False
    shadow = False
    ways = 0
    searching = True
    while searching:
        if inner_is_occluded(scene, origin, direction, left, end):
            shadow = True
        else:
            light = True
        forget_numbers(made)
        ways += 1
        searching = not (light and shadow) and next_way(was.recorded)
        if searching and ways == MOST_WAYS:
            light = True
            shadow = True
            searching = False
    resume(was)
    if light and shadow:
        return next_answer()
    return shadow
