"""How VTK lights what llvmpipe draws, in terms of the tracer's own equation.

VTK evaluates the classical equation at each fragment in float32, in view coordinates (vtkOpenGLPolyDataMapper.cxx,
ReplaceShaderNormal and ReplaceShaderLight). Here the tracer's own source is evaluated in balls; what VTK has that is
off by its own rounding is widened by as much: the position of the fragment (position_interpolation.py), the normal, the
cosines, the power function. Widths are of cubes that hold those in view coordinates however the camera is turned.

The functions here are source of the tracer, as those of ray_offsets.py. They keep the shadows that the truth has and
VTK has not: a scene is compared only where there are none (scenes/hidden_lights.py), and were that wrong, VTK would
fail.
"""

from __future__ import annotations

import math
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of
from raytruth.comparisons.error_models.rasterisers.drawn_pieces import ROUNDOFF, extent_of
from raytruth.comparisons.error_models.rasterisers.position_interpolation import position_errors
from raytruth.comparisons.error_models.rasterisers.view_volume import view_volume
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.features import BLINN, DIFFUSE, PERSPECTIVE, PHONG
from raytruth.reference_tracer.source.illumination import diffuse, specular
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_POSITION,
    MATERIAL_IS_LIT,
    MATERIAL_SPECULAR,
    TRIANGLE_MATERIAL,
    integer_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import is_shadowed
from raytruth.reference_tracer.source.traversal import surface_normal
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import add, along, cross, dot, multiply, negate, normalize, scale, subtract
from raytruth.scenes.lights import PointLight

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

# VTK's normal of a triangle is computed in float64 and stored in float32: 1 roundoff. It is multiplied with a matrix
# of rounded unit vectors: 1 for these, 3 for products, 2 for sums; normalised: 5 for the length. In all 12, to which
# come 2 of the picture of normals, that holds (n + 1)/2, in any direction, and so √3 times as much along an axis.
NORMAL_ROUNDOFFS = 32
# Of a light's position in view coordinates 1, and of the difference from the fragment 1; √3 times along an axis.
LIGHT_ROUNDOFFS = 4
# The unit vectors to a light and to the viewer are off by 5 roundoffs of 1, by their normalisation. Their product with
# the normal, or with each other, has 3 more. A mirrored l - 2(n·l)n is off by 5 of l, twice 8 of the product, and 3.
COSINE_ROUNDOFFS = 32
# The power function is exp2(n·log2(x)) (Mesa, lp_bld_arit.c). Its log2 has a polynomial of degree 4 in the square of
# (m - 1)/(m + 1), m the mantissa, that is off by 0.34 roundoffs, and 8 by rounding; then 1 of the sum with the
# exponent, and 2 of the product with the rounded n. VTK takes no cosine below 1e-5, so that |log2(x)| is 16.7 at most.
# In all 59 times n, times ln 2 of the result.
POWER_ROUNDOFFS = 41
# Its exp2 has a polynomial of degree 5 in the fraction, that is off by 2.5 roundoffs; 1 of the fraction, 8 of six sums
# and products of which the first ones count little, 1 of the last product.
EXPONENTIAL_ROUNDOFFS = 16
LEAST_COSINE = 1e-5
"""What VTK takes for the highlight's cosine where that is less (vtkOpenGLPolyDataMapper.cxx, ReplaceShaderLight)."""

window_spread: Vector = (0.0, 0.0, 0.0)
"""How far rounding of corners in the window may turn a ray's direction, or move the origin of a parallel ray."""
space_spread: Vector = (0.0, 0.0, 0.0)
"""How far float32 may move a corner in space, along each axis."""
in_window: list[Scalar] = []
"""For each triangle: how many times `window_spread` counts."""
in_space: list[Scalar] = []
"""For each triangle: how many times `space_spread` counts."""
position_spread: list[Scalar] = []
"""For each triangle: how far from where a ray meets it it is lit, along each axis, and what a light is off besides."""
side_spread: list[Scalar] = []
"""For each triangle: 0, or a ball that holds any number where snapping may turn it round."""
normal_spread: Scalar = 0.0
cosine_spread: Scalar = 0.0
least_cosine: Scalar = 0.0
power_spread: Scalar = 0.0
"""What the power function may be off, relatively, for each unit of the exponent."""
exponential_spread: Scalar = 0.0


def light_behaviour(scene: Scene, snapping: float, in_image: Any, moved: float) -> Behaviour:
    """What VTK's way to light does otherwise; to be merged with HELPERS. The constants are balls and lists of balls.

    `in_image` is what the rounding of a corner's place in the window makes of a ray's direction, or of its origin;
    `moved` the movement of a corner in space.
    """
    errors = position_errors(scene, view_volume(scene), snapping)
    # View coordinates are rounded along other axes than the scene's.
    bounds = math.sqrt(3) * errors.bounds + LIGHT_ROUNDOFFS * ROUNDOFF * _light_extent(scene)
    constants = {
        "window_spread": about_zero(in_image),
        "space_spread": about_zero([moved] * 3),
        "in_window": [arb(float(factor)) for factor in errors.in_window],
        "in_space": [arb(float(factor)) for factor in errors.in_space],
        "position_spread": about_zero(bounds),
        # Beyond any scalar product of a direction and a normal.
        "side_spread": about_zero(errors.either_side * 2.0**200),
        "normal_spread": arb(0, NORMAL_ROUNDOFFS * ROUNDOFF),
        "cosine_spread": arb(0, COSINE_ROUNDOFFS * ROUNDOFF),
        "least_cosine": arb(LEAST_COSINE / 2, LEAST_COSINE / 2),
        "power_spread": arb(0, POWER_ROUNDOFFS * ROUNDOFF),
        "exponential_spread": arb(0, EXPONENTIAL_ROUNDOFFS * ROUNDOFF),
    }
    functions: dict[str, Function] = {
        "triangle_normal": drawn_normal,
        "surface_at": drawn_surface,
        "direct_light": drawn_light,
        "is_shadowed": shadowed_by_any_triangle,
        "phong": drawn_highlight,
    }
    return Behaviour(functions, constants=constants, name="the light of a rasteriser")


def about_zero(radii: Any) -> list[Any]:
    """For each radius a ball around 0 that has it."""
    return [arb(0, float(radius)) for radius in radii]


def _light_extent(scene: Scene) -> float:
    """The largest coordinate, from the camera, of any light or lit point, or between two of these."""
    positions = [light.position for light in scene.lights if isinstance(light, PointLight)]
    from_camera = np.subtract(np.array(positions).reshape(-1, 3), scene.camera.position)
    return float(np.linalg.norm(from_camera, axis=1).max(initial=0.0)) + extent_of(scene)


def drawn_surface(
    scene: SceneData,
    origin: Vector,
    direction: Vector,
    distance: Scalar,  # noqa: ARG001 - the signature of the function it stands for; it is the z-buffer's
    primitive: int,
) -> tuple[Vector, Vector, bool]:
    """Where a fragment is lit, its normal turned to the viewer, and whether its front is seen, as VTK has them."""
    a, b, c = corners_of(scene, primitive)
    corner = add(a, scale(space_spread, in_space[primitive]))
    start = origin
    toward = direction
    if PERSPECTIVE:
        toward = add(toward, scale(window_spread, in_window[primitive]))
    else:
        start = add(start, scale(window_spread, in_window[primitive]))
    across = cross(subtract(b, a), subtract(c, a))
    point = along(start, toward, dot(subtract(corner, start), across) / dot(toward, across))
    error = position_spread[primitive]
    point = add(point, (error, error, error))
    outward = surface_normal(scene, primitive, point)
    entering = dot(direction, across) + side_spread[primitive] < 0.0
    normal = outward if entering else negate(outward)
    return point, normal, entering


def drawn_normal(a: Vector, b: Vector, c: Vector) -> Vector:
    """The unit normal of a triangle as it is drawn, in place of triangle_normal."""
    exact = normalize(cross(subtract(b, a), subtract(c, a)))
    return add(exact, (normal_spread, normal_spread, normal_spread))


def drawn_light(
    scene: SceneData,
    primitive: int,
    material: int,
    point: Vector,
    normal: Vector,
    direction: Vector,
    to_light: Vector,
    light_is_near: bool,
    arriving: Vector,
) -> Vector:
    """The diffuse and specular terms of one light, seen along the way to the fragment's own position."""
    if not integer_of(scene, MATERIAL_IS_LIT, material):
        return (0.0, 0.0, 0.0)
    toward_light = normalize(to_light)
    cosine = dot(normal, toward_light) + cosine_spread
    faces_light = cosine > 0.0
    if not faces_light:
        return (0.0, 0.0, 0.0)
    if is_shadowed(scene, primitive, point, normal, to_light, light_is_near):
        return (0.0, 0.0, 0.0)
    reflectance = (0.0, 0.0, 0.0)
    if DIFFUSE:
        reflectance = add(reflectance, scale(diffuse(scene, material, point), cosine))
    if PHONG or BLINN:
        seen_along = direction
        if PERSPECTIVE:
            seen_along = normalize(subtract(point, vector_of(scene, CAMERA_POSITION, 0)))
        highlight = specular(scene, material, normal, seen_along, toward_light)
        reflectance = add(reflectance, scale(vector_of(scene, MATERIAL_SPECULAR, material), highlight))
    return multiply(reflectance, arriving)


def shadowed_by_any_triangle(
    scene: SceneData,
    primitive: int,
    point: Vector,
    normal: Vector,  # noqa: ARG001 - the signature of the function it stands for
    to_light: Vector,
    light_is_near: bool,
) -> bool:
    """Whether a triangle hides the light, by the truth's own test: VTK draws no shadow rays, and none is rounded."""
    for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
        if triangle != primitive:
            a, b, c = corners_of(scene, triangle)
            distance = triangle_distance(point, to_light, a, b, c)
            if light_is_near:
                if distance < 1.0:
                    return True
            elif distance < inf:
                return True
    return False


def drawn_highlight(normal: Vector, direction: Vector, toward_light: Vector, exponent: Scalar) -> Scalar:
    """(r·v)^n by VTK's least cosine and Mesa's power function."""
    cosine = dot(mirror_direction(direction, normal), toward_light) + cosine_spread
    highlight: Scalar = max(cosine, least_cosine) ** exponent
    return highlight * (1.0 + (exponent * power_spread + exponential_spread))
