"""What Python calls of a compiled evaluator: the colours and the first hits of a list of pixels.

Part of the text of a kernel, as followed_rays.py is. Places are columns and rows of pixels, shape (n, 2). Where
`rays` has a row for each pixel, these are its camera rays, in balls; else the kernel's own camera makes them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.feasible_sets.box_balls import exact_ball, is_finite, pixel_center
from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES
from raytruth.comparisons.feasible_sets.followed_rays import add_waiting, follow_tree
from raytruth.comparisons.feasible_sets.plain_rays import box_of, forget_rays, keep_ray, kept_ray, known_number
from raytruth.comparisons.feasible_sets.ray_sums import sum_up
from raytruth.comparisons.feasible_sets.tree_memory import (
    ALL_WAYS,
    BOXES,
    DEPTH,
    IS_FULL,
    IS_REMEMBERED,
    LEFT,
    MEDIUM,
    MERGED,
    NODES,
    NUMBER_OF_COUNTS,
    RAY,
    REMEMBERED,
    SPENT,
    UNDECIDABLE,
    WAYS,
)
from raytruth.reference_tracer.arithmetics.scripted_decisions import (
    HAS_LOST,
    MOST_WAYS,
    POSITION,
    begin_decisions,
    next_answer,
    next_way,
    paused,
    resume,
    ways_left,
)
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.source.camera import primary_ray
from raytruth.reference_tracer.source.ray_tree import hit_point
from raytruth.reference_tracer.source.scene_data import CAMERA_MEDIUM, MAX_DEPTH, integer_of
from raytruth.reference_tracer.source.traversal import NOTHING, surface_normal
from raytruth.reference_tracer.source.traversal import is_occluded as inner_is_occluded
from raytruth.reference_tracer.source.traversal import nearest_hit as inner_nearest_hit

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


def color_pixels(
    scene: SceneData, frame: Any, places: Table, count: int, rays: Table, boxes: Table, told: Table
) -> None:
    """Boxes of the feasible colours of each pixel, shape (n, MOST_OUTCOMES, 3).

    And of each is told how many there are (0: nothing can be said), whether they are merged, and whether the pixel's
    work was spent; -1 boxes say that the evaluator had no room for it.
    """
    tree = state().tree
    for pixel in range(count):
        begin_pixel(frame, places[pixel, 0], places[pixel, 1], rays, pixel)
        begin_tree(scene)
        follow_tree(scene)
        sum_up()
        found = tree.nodes[0, BOXES]
        if tree.counts[UNDECIDABLE] == 1 or is_wide(found):
            found = 0
        if tree.counts[IS_FULL] == 1 or state().decisions.counts[HAS_LOST] == 1:
            found = -1
        told[pixel, 0] = found
        told[pixel, 1] = tree.counts[MERGED]
        told[pixel, 2] = tree.counts[SPENT]
        for place in range(found):
            for channel in range(3):
                boxes[pixel, place, channel] = tree.boxes[0, place, channel]


def is_wide(count: int) -> bool:
    """Whether a box of the camera ray spans more than half of all that a ray of the scene may bring."""
    if state().limits.has_bound == 1:
        for place in range(count):
            for channel in range(3):
                if not 2.0 * state().tree.boxes[0, place, channel].radius <= state().limits.at_camera / 2.0:
                    return True
    return False


def hit_pixels(
    scene: SceneData, frame: Any, places: Table, count: int, rays: Table, primitives: Table, values: Table, told: Table
) -> None:
    """What the ray of each pixel may meet first: primitives (n, MOST_OUTCOMES), and seven balls for each of them.

    And how many of these there are: 0 where nothing can be said, -1 where the evaluator had no room.
    """
    for pixel in range(count):
        begin_pixel(frame, places[pixel, 0], places[pixel, 1], rays, pixel)
        begin_decisions()
        found = 0
        is_open = True
        fits = True
        while is_open:
            fits = put_hit(scene, pixel, found, primitives, values)
            found = found + 1
            fits = fits and found + ways_left(0) <= MOST_OUTCOMES
            is_open = fits and next_way(0)
        told[pixel] = found if fits else 0
        if state().decisions.counts[HAS_LOST] == 1:
            told[pixel] = -1


def put_hit(scene: SceneData, pixel: int, place: int, primitives: Table, values: Table) -> bool:
    """A way that the camera ray may go; whether all of it is finite. A triangle seen edge on may be met anywhere."""
    origin, direction = kept_ray(0)
    distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
    primitives[pixel, place] = primitive
    if primitive == NOTHING:
        return True
    point = hit_point(scene, origin, direction, distance, primitive)
    normal = surface_normal(scene, primitive, point)
    values[pixel, place, 0] = box_of(distance)
    all_finite = is_finite(box_of(distance))
    for axis in range(3):
        values[pixel, place, axis + 1] = box_of(point[axis])
        values[pixel, place, axis + 4] = box_of(normal[axis])
        all_finite = all_finite and is_finite(box_of(point[axis])) and is_finite(box_of(normal[axis]))
    return all_finite


def begin_pixel(frame: Any, column: int, row: int, rays: Table, pixel: int) -> None:
    """Forget the last pixel, and keep the camera ray of this one."""
    for place in range(NUMBER_OF_COUNTS):
        state().tree.counts[place] = 0
    begin_decisions()
    forget_rays(0)
    radius = state().limits.image_radius
    if radius < 0.0:
        origin = (known_number(rays[pixel, 0]), known_number(rays[pixel, 1]), known_number(rays[pixel, 2]))
        direction = (known_number(rays[pixel, 3]), known_number(rays[pixel, 4]), known_number(rays[pixel, 5]))
        keep_ray(origin, direction)
    else:
        x, y = known_number(pixel_center(column, radius)), known_number(pixel_center(row, radius))
        origin, direction = primary_ray(frame, x, y)
        keep_ray(origin, direction)


def begin_tree(scene: SceneData) -> None:
    """A tree of the camera ray alone, which waits."""
    tree = state().tree
    tree.nodes[0, RAY] = 0
    tree.nodes[0, LEFT] = NOTHING
    tree.nodes[0, MEDIUM] = integer_of(scene, CAMERA_MEDIUM, 0)
    tree.nodes[0, DEPTH] = integer_of(scene, MAX_DEPTH, 0)
    tree.nodes[0, WAYS] = -1
    for channel in range(3):
        tree.weights[0, channel] = exact_ball(1.0)
    tree.counts[NODES] = 1
    tree.counts[ALL_WAYS] = 0
    add_waiting(0, MOST_OUTCOMES)


def nearest_hit(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """The kernel's nearest hit; the camera ray's, if no comparison was undecided, is not found twice for a pixel."""
    counts = state().tree.counts
    if left == NOTHING and counts[IS_REMEMBERED] == 1:
        return state().remembered[0], counts[REMEMBERED]
    before = state().decisions.counts[POSITION]
    distance, primitive = inner_nearest_hit(scene, origin, direction, left)
    if left == NOTHING and state().decisions.counts[POSITION] == before:
        state().remembered[0] = distance
        counts[REMEMBERED] = primitive
        counts[IS_REMEMBERED] = 1
    return distance, primitive


def is_occluded(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Whether anything hides a light, as one decision, however many comparisons it rests on (asked_once.py)."""
    was = paused()
    light = False
    shadow = False
    ways = 0
    is_open = True
    while is_open:
        if inner_is_occluded(scene, origin, direction, left, end):
            shadow = True
        else:
            light = True
        ways = ways + 1
        is_open = not (light and shadow) and next_way(was.recorded)
        if is_open and ways == MOST_WAYS:
            light = True
            shadow = True
            is_open = False
    resume(was)
    if light and shadow:
        return next_answer()
    return shadow
