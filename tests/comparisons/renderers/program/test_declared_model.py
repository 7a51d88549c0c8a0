from __future__ import annotations

from dataclasses import fields
from typing import Any, Literal, get_args, get_origin

import pytest

from raytruth.comparisons.error_models.departures import Departures
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.formulas import FORMULAS
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import has_shortcuts, without_shortcuts
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.renderers.program.declaration import Formulas
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration, formula_in_file
from raytruth.comparisons.renderers.program.model import Model
from raytruth.reference_tracer.camera_rays import CameraRays
from tests.reference_tracer.small_scenes import small_scene

pytestmark = pytest.mark.clause("REN-8")


def model(**keys: Any) -> ErrorModel:
    data = {"name": "mine", "command": ["a", "{scene}", "{output}", "{seed}"], **keys}
    return error_model_of_declaration(checked_declaration(data, "mine.toml"))


def test_without_a_word_it_is_float64_with_39_bits_and_no_shortcut() -> None:
    assert model() == ErrorModel("numbers of 39 bits, as declared", precision_bits=39)


@pytest.mark.parametrize(
    ("arithmetic", "bits"),
    [
        ({"precision": "float64"}, 53),
        ({"precision": "float32"}, 24),
        ({"precision": "float32", "slack_bits": 4}, 20),
        ({"bits": 30}, 30),
        ({"slack_bits": 2}, 37),
    ],
)
def test_the_bits_are_those_of_the_precision_less_the_slack(arithmetic: dict[str, Any], bits: int) -> None:
    assert model(arithmetic=arithmetic).precision_bits == bits


@pytest.mark.parametrize(
    ("rays", "offset"),
    [
        ({"offset": 1e-4, "relative_offset": 1e-5}, RayOffset(1e-4, 1e-5)),
        ({"least_distance": 1e-4}, RayOffset(minimum_distance=1e-4, excludes_surface=False)),
        ({"offset": 1e-4, "along": "ray"}, RayOffset(1e-4, along="direction", excludes_surface=False)),
        ({"offset": 1e-4, "own_surface": "tested"}, RayOffset(1e-4, excludes_surface=False)),
    ],
)
def test_an_epsilon_is_an_offset_or_a_least_distance(rays: dict[str, Any], offset: RayOffset) -> None:
    assert model(rays=rays).ray_offset == offset
    assert model(rays={"shadow_shortening": 0.01}).shadow_shortening == 0.01
    same = {kind: {"offset": rays["offset"]} for kind in ("shadow", "reflected", "refracted") if "offset" in rays}
    assert model(rays=rays | same).ray_offset == offset


def test_formulas_that_are_known_have_their_names() -> None:
    declared = model(
        formulas={"triangle": "pluecker", "triangle_points": "barycentric", "sphere_normals": "normalised"}
    )
    assert (declared.triangle_test, declared.triangle_points, declared.sphere_points) == (
        "pluecker",
        "barycentric",
        "normalised",
    )


@pytest.mark.clause("VER-16", "VER-17")
def test_conventions_and_departures_are_parts_of_the_error_model() -> None:
    conventions = {"pixel": "bottom right", "pitch": "size less one", "field_of_view": "smaller side", "scale": 255.0}
    declared = model(conventions=conventions, model={"end_of_depth": "local", "constant_weights": [0.25, 0.5]})
    assert declared.camera_rays == CameraRays(1.0, 1.0, edge_to_edge=True)
    assert declared.field_of_view == "smaller side"
    assert declared.output.scale == 255.0
    assert declared.departures == Departures("local", constant_weights=(0.25, 0.5))


def test_every_departure_can_be_declared_by_its_name() -> None:
    assert list(Model.model_fields) == [field.name for field in fields(Departures)]
    assert Model().departures() == Departures()


def test_paths_that_end_otherwise_are_judged_where_there_are_any() -> None:
    mirror = {"white": {"mirror": {"reflectance": (0.5, 0.5, 0.5)}}}
    departing = Model(end_of_depth="background")
    assert "could end otherwise" in str(departing.refuses(small_scene(materials=mirror, max_depth=0)))
    for model_of_scene, scene in (
        (departing, small_scene(materials=mirror, max_depth=1)),
        (departing, small_scene(max_depth=0)),
        (Model(), small_scene(materials=mirror, max_depth=0)),
    ):
        assert model_of_scene.refuses(scene) is None


def test_who_clamps_the_one_sample_of_a_pixel_writes_clipped_colours() -> None:
    clamped = {"conventions": {"clamped_samples": True}}
    assert model(**clamped).output.clipped
    assert not model(**clamped, sampling={"samples": 2}).output.clipped


@pytest.mark.clause("VER-5")
@pytest.mark.parametrize(
    ("keys", "output"),
    [
        ({"numbers": "half", "clipped": True}, OutputModel("float16", clipped=True)),
        ({"writes": "pfm", "colours": "srgb"}, OutputModel("float32", "sRGB")),
        ({"writes": "hdr"}, OutputModel("rgbe")),
        ({"writes": "png", "colours": "srgb"}, OutputModel("uint8", "sRGB", clipped=True)),
        (
            {"writes": "ppm", "numbers": "uint16", "rounding": "truncated"},
            OutputModel("uint16", rounding="truncation", clipped=True),
        ),
    ],
)
def test_the_output_follows_from_the_format(keys: dict[str, Any], output: OutputModel) -> None:
    assert model(**keys).output == output


def choices() -> list[tuple[str, str]]:
    """All values of [formulas]."""
    found = []
    for key, field in Formulas.model_fields.items():
        kinds = [kind for kind in (field.annotation, *get_args(field.annotation)) if get_origin(kind) is Literal]
        found += [(key, value) for kind in kinds for value in get_args(kind)]
    return found


@pytest.mark.parametrize(("key", "value"), choices())
def test_every_formula_that_can_be_declared_is_one_of_an_error_model(key: str, value: str) -> None:
    assert len(choices()) >= 18
    others = {"triangle": "pluecker"} if (key, value) == ("triangle_points", "barycentric") else {}
    declared, plain = model(formulas={key: value, **others}), model(formulas=others)
    assert (declared == plain) == (value == Formulas.model_fields[key].default)
    feasible = feasible_set(small_scene(), declared)
    assert feasible.outcomes.min() > 0


def test_every_formula_that_can_be_declared_has_a_line_of_code_and_means_that_one() -> None:
    in_file = {line: formula for formula in FORMULAS if (line := formula_in_file(formula)) is not None}
    assert in_file.keys() == set(choices())
    for (key, value), formula in in_file.items():
        others = {"triangle": "pluecker"} if value == "barycentric" else {}
        assert getattr(model(formulas={key: value, **others}), formula.field) == formula.value
    assert model(formulas={"triangle": "moeller-trumbore"}).triangle_test == "moeller-trumbore of 1997"


def test_the_epsilon_of_moeller_and_trumbore_is_a_shortcut() -> None:
    declared = model(formulas={"triangle": "moeller-trumbore", "least_determinant": 1e-6})
    assert declared.least_determinant == 1e-6
    assert has_shortcuts(declared)
    assert without_shortcuts(declared) == model(formulas={"triangle": "moeller-trumbore"})


def test_each_kind_of_ray_may_leave_a_surface_in_its_own_way() -> None:
    declared = model(rays={"offset": 1e-4, "shadow": {"least_distance": 1e-3, "offset": 0.0}, "refracted": {}})
    assert declared.ray_offset == declared.reflected_offset or declared.reflected_offset is None
    assert declared.shadow_offset == RayOffset(minimum_distance=1e-3, excludes_surface=False)
    assert declared.offsets()[1:] == (RayOffset(1e-4),) * 3
    assert declared.shadow_aim == "light"  # its shadow rays start on the surface
    aims = {aim: model(rays={"offset": 1e-4, "shadow_aim": aim}).shadow_aim for aim in ("light", "parallel", "either")}
    assert aims == {aim: aim for aim in aims}
    assert model(rays={"offset": 1e-4}).shadow_aim == "either"
    scaled = model(rays={"relative_least_distance": 1e-4})
    assert scaled.ray_offset == RayOffset(relative_minimum_distance=1e-4, excludes_surface=False)
    assert model(arithmetic={"smallest": 1e-38}).smallest == 1e-38


def test_programs_that_declare_the_same_share_feasible_sets() -> None:
    assert model() == model(reference=True, family="other", limits={"seconds": 3})
