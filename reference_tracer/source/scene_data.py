"""How the tracer's source reads the scene: tables of numbers and of integers, laid end to end in two arrays.

Two arrays instead of one a table keep compiled calls cheap: a call passes pointers, not forty array headers. The
integers begin with each table's start and its number of rows; reference_tracer/tables.py fills them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector

SPHERE_CENTER = 0
SPHERE_RADIUS = 1
SPHERE_MATERIAL = 2  # integers
TRIANGLE_A = 3
TRIANGLE_B = 4
TRIANGLE_C = 5
TRIANGLE_MATERIAL = 6  # integers
PLANE_POINT = 7
PLANE_NORMAL = 8  # of any length
PLANE_MATERIAL = 9  # integers
NODE_LOW = 10  # the tree of boxes, depth first
NODE_HIGH = 11
NODE_END = 12  # integers: the node that follows the node's whole subtree
NODE_FIRST_TRIANGLE = 13  # integers: a row of NODE_ORDER
NODE_TRIANGLES = 14  # integers: how many; 0 for an inner node
NODE_ORDER = 15  # integers: triangles
MATERIAL_IS_LIT = 16  # integers: 1 if it has a term that lights light
MATERIAL_EMISSION = 17
MATERIAL_EMISSION_BOARD = 18  # integers: a checkerboard, or -1
MATERIAL_AMBIENT = 19
MATERIAL_DIFFUSE = 20
MATERIAL_DIFFUSE_BOARD = 21  # integers: a checkerboard, or -1
MATERIAL_SPECULAR = 22
MATERIAL_EXPONENT = 23
MATERIAL_IS_BLINN = 24  # integers: 0 or 1
MATERIAL_IS_MIRROR = 25  # integers: 0 or 1
MATERIAL_MIRROR = 26
MATERIAL_IS_DIELECTRIC = 27  # integers: 0 or 1
MATERIAL_INDEX = 28
MATERIAL_OUTSIDE_INDEX = 29
MATERIAL_OUTSIDE = 30  # integers: a material, or -1 for empty space
MATERIAL_ABSORPTION = 31
MATERIAL_HAS_CONSTANT_SPLIT = 32  # integers: 0 or 1
MATERIAL_REFLECTANCE = 33
MATERIAL_TRANSMITTANCE = 34
CHECKERBOARD_EVEN = 35
CHECKERBOARD_ODD = 36
CHECKERBOARD_SIZE = 37
CHECKERBOARD_FIRST_OFFSET = 38
CHECKERBOARD_SECOND_OFFSET = 39
CHECKERBOARD_FIRST_AXIS = 40  # integers
CHECKERBOARD_SECOND_AXIS = 41  # integers
LIGHT_POSITION = 42
LIGHT_INTENSITY = 43
LIGHT_FALLOFF = 44  # integers: a kind
LIGHT_FALLOFF_COEFFICIENTS = 45
SUN_DIRECTION = 46
SUN_IRRADIANCE = 47
AMBIENT_LIGHT = 48
BACKGROUND_COLOR = 49
CAMERA_POSITION = 50
CAMERA_LOOK_AT = 51
CAMERA_UP = 52
CAMERA_EXTENT = 53  # vertical field of view in degrees, or the height of the visible rectangle
CAMERA_SIZE = 54  # integers: width and height in pixels
CAMERA_MEDIUM = 55  # integers: the material the camera is in, or -1
MAX_DEPTH = 56  # integers
NUMBER_OF_TABLES = 57


class SceneData(NamedTuple):
    """A scene as kernels read it: tables of numbers and of integers, by number."""

    numbers: Table
    integers: Table


def rows_of(scene: SceneData, table: int) -> int:
    """How many rows a table has; 0 for one that the scene does not require."""
    rows: int = scene.integers[NUMBER_OF_TABLES + table]
    return rows


def number_of(scene: SceneData, table: int, row: int) -> Scalar:
    """The number that stands in a row of a table."""
    number: Scalar = scene.numbers[scene.integers[table] + row]
    return number


def integer_of(scene: SceneData, table: int, row: int) -> int:
    """The integer that stands in a row of a table."""
    integer: int = scene.integers[scene.integers[table] + row]
    return integer


def vector_of(scene: SceneData, table: int, row: int) -> Vector:
    """The vector that stands in a row of a table."""
    start = scene.integers[table] + 3 * row
    return (scene.numbers[start], scene.numbers[start + 1], scene.numbers[start + 2])


def first_plane(scene: SceneData) -> int:
    """The number of the first plane among the primitives: planes come after spheres and triangles."""
    return rows_of(scene, SPHERE_MATERIAL) + rows_of(scene, TRIANGLE_MATERIAL)


def plane_of(scene: SceneData, primitive: int) -> int:
    """The number of a primitive among the planes; below 0 for a sphere, a triangle, or none."""
    return primitive - first_plane(scene)
