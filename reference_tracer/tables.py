"""Lays a scene out as the tables that the tracer's source reads (scene_data.py).

Only what the scene requires is stored.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.reference_tracer.bounding_volume_tree import build_tree
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.illumination import INVERSE_SQUARE, POLYNOMIAL
from raytruth.scenes.camera import PerspectiveCamera
from raytruth.scenes.features import Feature
from raytruth.scenes.lights import ConstantBackground, DirectionalLight, PointLight, PolynomialFalloff
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from numpy.typing import ArrayLike, NDArray

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.scenes.lights import Falloff
    from raytruth.scenes.materials import Checkerboard, Texture
    from raytruth.scenes.scene import Scene

BLACK = (0.0, 0.0, 0.0)
FALLOFF_KINDS = {"none": 0, "inverse_square": INVERSE_SQUARE}
CHECKERBOARD_AXES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


class _Tables:
    """Tables by number, of numbers or of integers."""

    def __init__(self) -> None:
        self.numbers: dict[int, NDArray[np.float64]] = {}
        self.integers: dict[int, NDArray[np.int64]] = {}

    def add(self, table: int, values: ArrayLike) -> None:
        self.numbers[table] = np.asarray(values, dtype=np.float64)

    def add_integers(self, table: int, values: ArrayLike) -> None:
        self.integers[table] = np.asarray(values, dtype=np.int64)


def build_tables(scene: Scene, features: Collection[str], arithmetic: Arithmetic) -> layout.SceneData:
    """The scene for a kernel in this arithmetic with these features."""
    tables = _Tables()
    _add_camera(scene, tables)
    _add_shapes(scene, features, tables)
    _add_local_terms(scene, features, tables)
    if Feature.DIELECTRICS in features:
        _add_dielectrics(scene, features, tables)
    if Feature.ABSORPTION in features:
        dielectrics = (material.dielectric for material in scene.materials.values())
        tables.add(layout.MATERIAL_ABSORPTION, [(term and term.absorption) or BLACK for term in dielectrics])
    _add_lights(scene, features, tables)
    return _laid_end_to_end(tables, arithmetic)


def _laid_end_to_end(tables: _Tables, arithmetic: Arithmetic) -> layout.SceneData:
    starts = np.zeros(layout.NUMBER_OF_TABLES, dtype=np.int64)
    rows = np.zeros(layout.NUMBER_OF_TABLES, dtype=np.int64)
    end_of_numbers = 0
    for table, values in tables.numbers.items():
        starts[table], rows[table] = end_of_numbers, len(values)
        end_of_numbers += values.size
    end_of_integers = 2 * layout.NUMBER_OF_TABLES
    for table, integers in tables.integers.items():
        starts[table], rows[table] = end_of_integers, len(integers)
        end_of_integers += integers.size
    numbers = np.concatenate([np.empty(0), *(values.ravel() for values in tables.numbers.values())])
    integers = np.concatenate([starts, rows, *tables.integers.values()])
    return layout.SceneData(arithmetic.numbers(numbers), arithmetic.integers(integers))


def _add_camera(scene: Scene, tables: _Tables) -> None:
    camera = scene.camera
    extent = camera.vertical_field_of_view if isinstance(camera, PerspectiveCamera) else camera.view_height
    tables.add(layout.CAMERA_POSITION, [camera.position])
    tables.add(layout.CAMERA_LOOK_AT, [camera.look_at])
    tables.add(layout.CAMERA_UP, [camera.up])
    tables.add(layout.CAMERA_EXTENT, [extent])
    tables.add_integers(layout.CAMERA_SIZE, [camera.width, camera.height])
    tables.add_integers(layout.CAMERA_MEDIUM, [material_number(scene, camera.inside)])
    tables.add_integers(layout.MAX_DEPTH, [scene.max_depth])


def _add_shapes(scene: Scene, features: Collection[str], tables: _Tables) -> None:
    names = list(scene.materials)
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    if spheres:
        tables.add(layout.SPHERE_CENTER, [sphere.center for sphere in spheres])
        tables.add(layout.SPHERE_RADIUS, [sphere.radius for sphere in spheres])
        tables.add_integers(layout.SPHERE_MATERIAL, [names.index(sphere.material) for sphere in spheres])
    corners, materials = triangles_of(scene)
    if materials:
        for table, corner in ((layout.TRIANGLE_A, 0), (layout.TRIANGLE_B, 1), (layout.TRIANGLE_C, 2)):
            tables.add(table, corners[:, corner])
        tables.add_integers(layout.TRIANGLE_MATERIAL, [names.index(name) for name in materials])
    planes = [shape for shape in scene.objects if isinstance(shape, Plane)]
    if planes:
        tables.add(layout.PLANE_POINT, [plane.point for plane in planes])
        tables.add(layout.PLANE_NORMAL, [plane.normal for plane in planes])
        tables.add_integers(layout.PLANE_MATERIAL, [names.index(plane.material) for plane in planes])
    if Feature.BOUNDING_VOLUMES in features:
        tree = build_tree(corners)
        tables.add(layout.NODE_LOW, tree.low)
        tables.add(layout.NODE_HIGH, tree.high)
        tables.add_integers(layout.NODE_END, tree.end)
        tables.add_integers(layout.NODE_FIRST_TRIANGLE, tree.first)
        tables.add_integers(layout.NODE_TRIANGLES, tree.count)
        tables.add_integers(layout.NODE_ORDER, tree.order)


def triangles_of(scene: Scene) -> tuple[NDArray[np.float64], list[str]]:
    """Corners of all triangles, shape (n, 3, 3), in the order of their numbers, and their materials' names."""
    corners: list[NDArray[np.float64]] = [np.empty((0, 3, 3))]
    materials: list[str] = []
    for shape in scene.objects:
        if isinstance(shape, Mesh):
            corners.append(np.array(shape.vertices)[np.array(shape.faces)])
            materials.extend([shape.material] * len(shape.faces))
        elif not isinstance(shape, Sphere | Plane):
            corners.append(np.array([shape.vertices]))
            materials.append(shape.material)
    return np.concatenate(corners), materials


def _add_local_terms(scene: Scene, features: Collection[str], tables: _Tables) -> None:
    materials = list(scene.materials.values())
    boards: list[Checkerboard] = []
    if Feature.POINT_LIGHTS in features or Feature.DIRECTIONAL_LIGHTS in features:
        lit = ["lights" in material.light_from() for material in materials]
        tables.add_integers(layout.MATERIAL_IS_LIT, lit)
    if Feature.EMISSION in features:
        radiances = [m.emission.radiance if m.emission else BLACK for m in materials]
        _add_textured(radiances, boards, tables, layout.MATERIAL_EMISSION, layout.MATERIAL_EMISSION_BOARD)
    if Feature.DIFFUSE in features:
        reflectances = [m.diffuse.reflectance if m.diffuse else BLACK for m in materials]
        _add_textured(reflectances, boards, tables, layout.MATERIAL_DIFFUSE, layout.MATERIAL_DIFFUSE_BOARD)
    if Feature.AMBIENT in features:
        tables.add(layout.MATERIAL_AMBIENT, [m.ambient.reflectance if m.ambient else BLACK for m in materials])
        tables.add(layout.AMBIENT_LIGHT, [scene.ambient_light])
    if Feature.PHONG in features or Feature.BLINN in features:
        speculars = [material.specular for material in materials]
        tables.add(layout.MATERIAL_SPECULAR, [term.reflectance if term else BLACK for term in speculars])
        tables.add(layout.MATERIAL_EXPONENT, [term.exponent if term else 1.0 for term in speculars])
        if Feature.PHONG in features and Feature.BLINN in features:
            tables.add_integers(layout.MATERIAL_IS_BLINN, [bool(term and term.model == "blinn") for term in speculars])
    if Feature.MIRRORS in features:
        tables.add(layout.MATERIAL_MIRROR, [m.mirror.reflectance if m.mirror else BLACK for m in materials])
        tables.add_integers(layout.MATERIAL_IS_MIRROR, [m.mirror is not None for m in materials])
    if Feature.CHECKERBOARD in features:
        _add_checkerboards(boards, tables)


def _add_textured(
    textures: Sequence[Texture], boards: list[Checkerboard], tables: _Tables, constant_table: int, board_table: int
) -> None:
    """A term's constant colours, and the number of its checkerboard or -1."""
    constants = []
    board_numbers = []
    for texture in textures:
        if isinstance(texture, tuple):
            constants.append(texture)
            board_numbers.append(-1)
        else:
            constants.append(BLACK)
            board_numbers.append(len(boards))
            boards.append(texture.checkerboard)
    tables.add(constant_table, constants)
    tables.add_integers(board_table, board_numbers)


def _add_checkerboards(boards: list[Checkerboard], tables: _Tables) -> None:
    tables.add(layout.CHECKERBOARD_EVEN, [board.even for board in boards])
    tables.add(layout.CHECKERBOARD_ODD, [board.odd for board in boards])
    tables.add(layout.CHECKERBOARD_SIZE, [board.size for board in boards])
    tables.add(layout.CHECKERBOARD_FIRST_OFFSET, [board.offset[0] for board in boards])
    tables.add(layout.CHECKERBOARD_SECOND_OFFSET, [board.offset[1] for board in boards])
    tables.add_integers(layout.CHECKERBOARD_FIRST_AXIS, [CHECKERBOARD_AXES[board.plane][0] for board in boards])
    tables.add_integers(layout.CHECKERBOARD_SECOND_AXIS, [CHECKERBOARD_AXES[board.plane][1] for board in boards])


def _add_dielectrics(scene: Scene, features: Collection[str], tables: _Tables) -> None:
    terms = [material.dielectric for material in scene.materials.values()]
    indices = [term.index_of_refraction if term else 1.0 for term in terms]
    outside = [material_number(scene, term.outside if term else None) for term in terms]
    tables.add_integers(layout.MATERIAL_IS_DIELECTRIC, [term is not None for term in terms])
    tables.add(layout.MATERIAL_INDEX, indices)
    tables.add_integers(layout.MATERIAL_OUTSIDE, outside)
    tables.add(layout.MATERIAL_OUTSIDE_INDEX, [indices[row] if row >= 0 else 1.0 for row in outside])
    if Feature.CONSTANT_SPLIT in features:
        constant = [bool(term and term.reflectance is not None) for term in terms]
        tables.add_integers(layout.MATERIAL_HAS_CONSTANT_SPLIT, constant)
        tables.add(layout.MATERIAL_REFLECTANCE, [(term and term.reflectance) or BLACK for term in terms])
        tables.add(layout.MATERIAL_TRANSMITTANCE, [(term and term.transmittance) or BLACK for term in terms])


def _add_lights(scene: Scene, features: Collection[str], tables: _Tables) -> None:
    points = [light for light in scene.lights if isinstance(light, PointLight)]
    suns = [light for light in scene.lights if isinstance(light, DirectionalLight)]
    if Feature.POINT_LIGHTS in features:
        tables.add(layout.LIGHT_POSITION, [light.position for light in points])
        tables.add(layout.LIGHT_INTENSITY, [light.intensity for light in points])
        _add_falloffs([light.falloff for light in points], features, tables)
    if Feature.DIRECTIONAL_LIGHTS in features:
        tables.add(layout.SUN_DIRECTION, [light.direction for light in suns])
        tables.add(layout.SUN_IRRADIANCE, [light.irradiance for light in suns])
    if Feature.BACKGROUND in features or Feature.BACKGROUND_GRADIENT in features:
        background = scene.background
        if isinstance(background, ConstantBackground):
            tables.add(layout.BACKGROUND_COLOR, [background.color])
        else:
            tables.add(layout.BACKGROUND_COLOR, [background.bottom, background.top])


def _add_falloffs(falloffs: Sequence[Falloff], features: Collection[str], tables: _Tables) -> None:
    if Feature.INVERSE_SQUARE_FALLOFF in features or Feature.POLYNOMIAL_FALLOFF in features:
        kinds = [FALLOFF_KINDS[falloff] if isinstance(falloff, str) else POLYNOMIAL for falloff in falloffs]
        tables.add_integers(layout.LIGHT_FALLOFF, kinds)
    if Feature.POLYNOMIAL_FALLOFF in features:
        polynomials = [falloff if isinstance(falloff, PolynomialFalloff) else None for falloff in falloffs]
        coefficients = [(f.constant, f.linear, f.quadratic) if f else BLACK for f in polynomials]
        tables.add(layout.LIGHT_FALLOFF_COEFFICIENTS, coefficients)


def material_number(scene: Scene, name: str | None) -> int:
    """The material's row, or -1 (empty space) for no name."""
    return -1 if name is None else list(scene.materials).index(name)
