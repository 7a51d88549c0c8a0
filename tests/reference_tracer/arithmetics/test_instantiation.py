from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.instantiation import (
    COMPILED_ENTRY_POINTS,
    exact_functions,
    kernel_source,
    source_module,
)
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.rendering import prepare, render
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.tables import build_tables
from raytruth.scenes.features import Feature
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import required_features
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("SCN-6")

# Functions that belong to one feature each, and to no other.
FUNCTIONS_OF = {
    Feature.SPHERES: {"nearest_sphere", "sphere_distance", "distance_to_other_side", "sphere_normal"},
    Feature.TRIANGLES: {"nearest_triangle", "triangle_distance", "triangle_normal"},
    Feature.BOUNDING_VOLUMES: {"box_is_missed", "clip"},
    Feature.CHECKERBOARD: {"is_even_square"},
    Feature.EMISSION: {"emission"},
    Feature.AMBIENT: {"ambient"},
    Feature.DIFFUSE: {"diffuse"},
    Feature.PHONG: {"phong"},
    Feature.BLINN: {"blinn"},
    Feature.POINT_LIGHTS: {"attenuation"},
    Feature.DIELECTRICS: {"fresnel_reflectance", "refracted_direction", "snell_discriminant", "split", "index_ratio"},
    Feature.ABSORPTION: {"medium_transmittance"},
}
# These choose between two ways, so that neither is an addition that a scene could do without.
ALTERNATIVES = {Feature.PERSPECTIVE, Feature.RADIOMETRIC, Feature.BACKGROUND_GRADIENT}


def names_in(source: str) -> set[str]:
    return {node.id for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Name)} | functions_in(source)


def functions_in(source: str) -> set[str]:
    return {node.name for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)}


def source_of(scene: Scene) -> str:
    return kernel_source(required_features(scene), entry_points=COMPILED_ENTRY_POINTS)[0]


SOURCES = {name: source_of(open_scene(name)) for name in library_names()}


@pytest.mark.parametrize("name", library_names())
def test_a_kernel_has_the_functions_of_its_scenes_features_and_no_others(name: str) -> None:
    required = required_features(open_scene(name))
    functions = functions_in(SOURCES[name])
    for feature, own in FUNCTIONS_OF.items():
        assert own <= functions if feature in required else not own & functions, feature
    # Two features share these.
    assert ("mirror_direction" in functions) == bool(required & {Feature.MIRRORS, Feature.DIELECTRICS, Feature.PHONG})
    assert ("trace_ray" in functions) == bool(required & {Feature.MIRRORS, Feature.DIELECTRICS})
    assert ("specular" in functions) == bool(required & {Feature.PHONG, Feature.BLINN})
    assert not names_in(SOURCES[name]) & {feature.value for feature in Feature}


@pytest.mark.parametrize("name", library_names())
def test_the_tables_that_a_kernel_reads_are_stored_and_no_others(name: str) -> None:
    scene = open_scene(name)
    data = build_tables(scene, required_features(scene), FLOAT)
    tables = {table for table, number in vars(layout).items() if table.isupper() and type(number) is int}
    tables -= {"NUMBER_OF_TABLES"}
    read = names_in(SOURCES[name]) & tables
    stored = {table for table in tables if layout.rows_of(data, getattr(layout, table)) > 0}
    assert stored <= read
    # Primitives are told apart by their numbers, so both kinds are looked up although there may be none of one.
    may_be_empty = {"SPHERE_MATERIAL", "TRIANGLE_MATERIAL"}
    assert read - may_be_empty <= stored


def test_every_function_of_the_source_is_reached_by_some_library_scene() -> None:
    whole = {node.name for node in source_module().body if isinstance(node, ast.FunctionDef)}
    # The kernels of pixels one by one, for Python, are not compiled.
    reached = set().union(*map(functions_in, SOURCES.values()))
    assert whole == reached


def test_every_feature_is_required_by_some_library_scene() -> None:
    assert set().union(*(required_features(open_scene(name)) for name in library_names())) == set(Feature)


@pytest.mark.clause("ILL-8")
@pytest.mark.parametrize("name", ["phong-sphere", "plane-mirror", "tinted-glass", "directional-light", "trefoil-knot"])
def test_features_that_a_scene_does_not_require_do_not_change_its_picture(name: str) -> None:
    scene = library_scene(name, 6, 4)
    required = required_features(scene)
    addable = set(Feature) - ALTERNATIVES - required
    if Feature.TRIANGLES not in required:
        addable -= {Feature.BOUNDING_VOLUMES}  # there is no tree of no triangles
    expected = render(scene, FLOAT)
    assert (rendered_with(scene, required | addable) == expected).all()
    if name == "phong-sphere":  # one after the other takes some seconds
        for feature in addable:
            added = {feature, Feature.DIELECTRICS} if feature == Feature.ABSORPTION else {feature}
            assert (rendered_with(scene, required | added) == expected).all(), feature


def rendered_with(scene: Scene, features: Any) -> Any:
    kernel = make_kernel(FLOAT, features)
    image = FLOAT.image(scene.camera.height, scene.camera.width, 3)
    kernel.render_rows(build_tables(scene, features, FLOAT), 1, 0, scene.camera.height, image)
    return image


def no_shadows(scene, primitive, point, normal, to_light, light_is_near):  # type: ignore[no-untyped-def]  # noqa: ARG001 - a signature
    return False


def brighter(scene, light, distance_squared):  # type: ignore[no-untyped-def]  # noqa: ARG001 - the signature of attenuation
    """Uses a function of the source, and a literal."""
    return dot((1.0, 1.0, 1.0), (1.0, 0.5, 0.5))  # type: ignore[name-defined] # noqa: F821 - where it is put it is known


@pytest.mark.clause("ARI-2")
def test_an_override_takes_effect_and_may_use_what_the_source_has() -> None:
    scene = small_scene(lights=[lamp((0.0, 0.0, 3.0))])
    assert render(scene, FLOAT)[0, 0, 0] == 1.0
    assert render(scene, FLOAT, Behaviour({"attenuation": brighter}))[0, 0, 0] == 2.0
    assert render(scene, FLOAT)[0, 0, 0] == 1.0


@pytest.mark.clause("ARI-2")
def test_what_only_the_overridden_function_needed_is_left_out() -> None:
    features = required_features(open_scene("single-sphere"))
    assert "is_occluded" in kernel_source(features)[0]
    assert "is_occluded" not in kernel_source(features, Behaviour({"is_shadowed": no_shadows}))[0]


@pytest.mark.clause("ARI-2")
def test_an_unknown_function_cannot_be_overridden() -> None:
    with pytest.raises(KeyError, match="no function is_shadowy "):
        prepare(small_scene(), FLOAT, Behaviour({"is_shadowy": no_shadows}))


@pytest.mark.clause("ARI-1")
def test_float_literals_are_named_and_whole_numbers_stay() -> None:
    source, literals = kernel_source(set(Feature))
    assert not [n for n in ast.walk(ast.parse(source)) if isinstance(n, ast.Constant) and isinstance(n.value, float)]
    assert literals["number_0_5"] == 0.5
    assert set(literals) <= names_in(source)


@pytest.mark.clause("ARI-3")
def test_decided_comparisons_leave_no_operator_to_compare_with() -> None:
    source, _ = kernel_source(set(Feature), decided_comparisons=True)
    nodes = list(ast.walk(ast.parse(source)))
    assert not [node for node in nodes if isinstance(node, ast.Compare | ast.Pow)]
    assert {"is_less", "is_equal", "power"} <= names_in(source)


class Unrounded(ast.NodeTransformer):
    """Takes the roundings away again, and counts them."""

    def __init__(self) -> None:
        self.factors = self.calls = 0

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        self.generic_visit(node)
        if isinstance(node.right, ast.Name) and node.right.id == "roundoff_factor":
            self.factors += 1
            return node.left
        return node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "rounded":
            self.calls += 1
            return node.args[0]
        return node


@pytest.mark.clause("ARI-3")
def test_each_operation_is_rounded_once_and_nothing_else_is_changed() -> None:
    exact, _ = kernel_source(set(Feature), Behaviour(PLAIN_FORMS), decided_comparisons=True)
    rounded, _ = kernel_source(set(Feature), Behaviour(PLAIN_FORMS), decided_comparisons=True, rounded_operations=True)
    unrounded = Unrounded()
    assert ast.unparse(unrounded.visit(ast.parse(rounded))) == ast.unparse(ast.parse(exact))
    functions = [f for f in ast.parse(exact).body if isinstance(f, ast.FunctionDef) and f.name not in exact_functions()]
    operations = [n for function in functions for n in ast.walk(function) if isinstance(n, ast.BinOp)]
    assert unrounded.factors + unrounded.calls == len(operations)
    assert unrounded.factors > 5 * unrounded.calls  # calls take as long as the operations that they round


@pytest.mark.clause("ARI-3")
def test_whole_numbers_are_not_rounded() -> None:
    text, _ = kernel_source(set(Feature), decided_comparisons=True, rounded_operations=True)
    for operation in ("left - spheres", "spheres + triangle", "depth - 1", "column + row"):
        assert f"rounded({operation})" in text


def each_kind(origin: Any, direction: Any, distance: Any) -> Any:
    """In place of `along`: sums and products of what is, or may not be, a number."""
    sum_of_names = distance + origin
    negative = -distance / origin
    coordinate = origin[0] - distance
    literal = -1.0 + distance
    nested = distance + (origin - direction * distance)
    return sum_of_names, negative, coordinate, literal, nested


@pytest.mark.clause("ARI-3")
def test_how_an_operation_is_rounded() -> None:
    text, _ = kernel_source(set(Feature), Behaviour({"along": each_kind}), rounded_operations=True)
    for line in (
        "sum_of_names = rounded(distance + origin)",
        "negative = -distance / origin * roundoff_factor",
        "coordinate = (origin[0] - distance) * roundoff_factor",
        "literal = (-number_1_0 + distance) * roundoff_factor",
        "nested = (distance + (origin - direction * distance * roundoff_factor) * roundoff_factor) * roundoff_factor",
    ):
        assert line in text
