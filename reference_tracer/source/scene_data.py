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
NODE_LOW = 7  # the tree of boxes, depth first
NODE_HIGH = 8
NODE_END = 9  # integers: the node that follows the node's whole subtree
NODE_FIRST_TRIANGLE = 10  # integers: a row of NODE_ORDER
NODE_TRIANGLES = 11  # integers: how many; 0 for an inner node
NODE_ORDER = 12  # integers: triangles
MATERIAL_IS_LIT = 13  # integers: 1 if it has a term that lights light
MATERIAL_EMISSION = 14
MATERIAL_EMISSION_BOARD = 15  # integers: a checkerboard, or -1
MATERIAL_AMBIENT = 16
MATERIAL_DIFFUSE = 17
MATERIAL_DIFFUSE_BOARD = 18  # integers: a checkerboard, or -1
MATERIAL_SPECULAR = 19
MATERIAL_EXPONENT = 20
MATERIAL_IS_BLINN = 21  # integers: 0 or 1
MATERIAL_IS_MIRROR = 22  # integers: 0 or 1
MATERIAL_MIRROR = 23
MATERIAL_IS_DIELECTRIC = 24  # integers: 0 or 1
MATERIAL_INDEX = 25
MATERIAL_OUTSIDE_INDEX = 26
MATERIAL_OUTSIDE = 27  # integers: a material, or -1 for empty space
MATERIAL_ABSORPTION = 28
MATERIAL_HAS_CONSTANT_SPLIT = 29  # integers: 0 or 1
MATERIAL_REFLECTANCE = 30
MATERIAL_TRANSMITTANCE = 31
CHECKERBOARD_EVEN = 32
CHECKERBOARD_ODD = 33
CHECKERBOARD_SIZE = 34
CHECKERBOARD_FIRST_OFFSET = 35
CHECKERBOARD_SECOND_OFFSET = 36
CHECKERBOARD_FIRST_AXIS = 37  # integers
CHECKERBOARD_SECOND_AXIS = 38  # integers
LIGHT_POSITION = 39
LIGHT_INTENSITY = 40
LIGHT_FALLOFF = 41  # integers: a kind
LIGHT_FALLOFF_COEFFICIENTS = 42
SUN_DIRECTION = 43
SUN_IRRADIANCE = 44
AMBIENT_LIGHT = 45
BACKGROUND_COLOR = 46
CAMERA_POSITION = 47
CAMERA_LOOK_AT = 48
CAMERA_UP = 49
CAMERA_EXTENT = 50  # vertical field of view in degrees, or the height of the visible rectangle
CAMERA_SIZE = 51  # integers: width and height in pixels
CAMERA_MEDIUM = 52  # integers: the material the camera is in, or -1
MAX_DEPTH = 53  # integers
NUMBER_OF_TABLES = 54


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
