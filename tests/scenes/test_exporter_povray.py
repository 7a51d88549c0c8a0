"""What is written for POV-Ray, as text; tests/comparisons shows that POV-Ray reads it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from raytruth.scenes.exporters.povray import export_povray, options_of
from raytruth.scenes.exporters.povray_limits import DEEPEST, FARTHEST, unit_of
from raytruth.scenes.exporters.povray_materials import fading
from raytruth.scenes.exporters.povray_text import block, comment, vector
from raytruth.scenes.lights import PolynomialFalloff
from tests.scenes.exporter_scenes import BALL, FLOOR, GLASS, LAMP, MIRROR, PLANE, POINT, RED, SUN, build

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-2")

numbers = st.floats(allow_nan=False, allow_infinity=False)
HIGHLIGHT = {"specular": {"reflectance": (0.5, 0.4, 0.3), "exponent": 20.5, "model": "phong"}}


def export(folder: Path, **changes: Any) -> str:
    return export_povray(build(**changes), folder).read_text(encoding="utf-8")


@given(st.lists(numbers, min_size=1, max_size=5))
def test_numbers_read_back_exactly(values: list[float]) -> None:
    assert [float(word) for word in vector(values).strip("<>").split(",")] == values


@given(st.text())
def test_a_comment_is_one_line_whatever_the_text(text: str) -> None:
    line = comment(text)
    assert line.startswith("// ")
    assert line.splitlines() == [line[:-1]]


def test_a_purpose_cannot_smuggle_in_a_statement(tmp_path: Path) -> None:
    assert "\n#include" not in export(tmp_path, purpose="A test.\n#include")


def test_blocks_are_indented() -> None:
    assert block("a", "b") == "a { b }"
    assert block("a", "b", block("c", "d", "e")) == "a {\n  b\n  c {\n    d\n    e\n  }\n}"


def test_a_scene_that_is_refused_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="because"):
        export(tmp_path, max_depth=60)
    assert list(tmp_path.iterdir()) == []


def test_each_term_is_a_texture_of_its_own_and_the_first_has_the_weight_one(tmp_path: Path) -> None:
    text = export(tmp_path, materials={"m": RED | HIGHLIGHT | MIRROR | LAMP}, lights=[POINT], max_depth=1)
    weights = (
        "[1 material_0_diffuse] [faint material_0_highlight] [faint material_0_emission] [faint material_0_mirror]"
    )
    assert f"average texture_map {{ {weights} }}" in text
    assert "phong 1/faint phong_size 20.5" in text
    assert "diffuse 1/pi }" in text


def test_terms_that_the_scene_gives_no_value_are_not_written(tmp_path: Path) -> None:
    text = export(tmp_path, materials={"m": RED | MIRROR})
    assert "material_0 = texture { material_0_black }" in text
    assert "reflection" not in text
    assert "light_source" not in text


def test_a_dielectric_throws_its_shadow_by_a_second_object_and_has_an_interior_texture(tmp_path: Path) -> None:
    text = export(tmp_path, materials={"m": GLASS}, max_depth=2)
    assert text.count("sphere {\n") == 2
    assert "hollow no_shadow" in text
    assert "no_image no_reflection" in text
    # Radiance changes with the square of the index, the other way round on the way out.
    inward, outward = (float(weight) for weight in re.findall(r"rgbf <([\d.]+), ", text))
    assert inward * outward == pytest.approx(1.0)


def test_a_parallel_light_stands_beyond_all_objects(tmp_path: Path) -> None:
    text = export(tmp_path, lights=[SUN], objects=[BALL, FLOOR])
    found = re.search(r"light_source \{\s*<(.*?), (.*?), (.*?)>\*unit", text)
    assert found
    assert float(found[2]) > BALL["center"][1] + BALL["radius"]  # type: ignore[index, operator]  # a dict of a scene


def test_corners_run_clockwise(tmp_path: Path) -> None:
    a, b, c = (vector(corner) for corner in FLOOR["vertices"])  # type: ignore[attr-defined]  # as above
    assert f"triangle {{ {a}*unit, {c}*unit, {b}*unit }}" in export(tmp_path, objects=[FLOOR])


def test_the_exposure_is_one_number_that_all_that_shines_is_multiplied_by(tmp_path: Path) -> None:
    scene = build(
        materials={"m": LAMP},
        lights=[POINT, SUN],
        ambient_light=(0.1, 0.1, 0.1),
        background={"bottom": (0.1, 0.2, 0.3), "top": (0.3, 0.2, 0.1)},
    )
    full, dark = (export_povray(scene, tmp_path, exposure=e).read_text(encoding="utf-8") for e in (1.0, 0.25))
    assert dark == full.replace("#declare exposure = 1.0;", "#declare exposure = 0.25;")
    # Two lights, emission, ambient light, and both ends of the gradient.
    assert len(re.findall(r"\*exposure|emission exposure", full)) == 6


def test_options_ask_for_one_ray_a_pixel_and_linear_numbers() -> None:
    options = options_of(build())
    assert {"-A", "+W32", "+H24", "+FN16", "File_Gamma=1.0", "Dither=off"} <= set(options)


@given(st.floats(1.0, 1e6), st.floats(1e-6, 1e6), st.floats(1e-3, 1e3))
def test_a_polynomial_without_linear_term_is_an_attenuation_of_povrays_own(
    constant: float, quadratic: float, distance: float
) -> None:
    fades = fading(PolynomialFalloff(constant=constant, linear=0.0, quadratic=quadratic))
    assert fades is not None
    factor, fade_distance = fades
    expected = 1 / (constant + quadratic * distance * distance)
    assert factor * 2 / (1 + (distance / fade_distance) ** 2) == pytest.approx(expected, rel=16 * 2.0**-53)


@given(st.floats(0.0, 2.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_an_attenuation_with_linear_term_or_cut_off_at_1_is_none_of_povrays_own(
    constant: float, linear: float, quadratic: float
) -> None:
    assume(constant + linear + quadratic > 0)
    its_own = linear == 0 and constant >= 1 and quadratic > 0
    assert (fading(PolynomialFalloff(constant=constant, linear=linear, quadratic=quadratic)) is not None) == its_own


def test_a_plane_is_its_unit_normal_and_its_distance_along_it(tmp_path: Path) -> None:
    text = export(tmp_path, objects=[PLANE])
    normal = "vnormalize(<0.0, 2.0, 0.0>)"
    assert f"{normal}, vdot(<0.3, -1.0, 0.2>, {normal})*unit" in text


def test_over_planes_the_sun_stands_behind_all_that_shadow_rays_may_meet(tmp_path: Path) -> None:
    def sun_of(text: str) -> float:
        found = re.search(r"light_source {\s+<([^>]*)>\*unit", text)
        assert found is not None
        return float(found[1].split(",")[1])

    assert sun_of(export(tmp_path, objects=[BALL], lights=[SUN])) < 10
    over_plane = export(tmp_path, objects=[BALL, PLANE], lights=[SUN])
    # As many rays of the farthest distance one after the other as there may be, and one more.
    assert sun_of(over_plane) > (DEEPEST + 2) * FARTHEST / unit_of(build(objects=[BALL, PLANE], lights=[SUN]))
    assert "point_at <0.2, -0.4, 0.25>*unit" in over_plane


def test_an_opaque_plane_has_the_camera_outside_and_one_of_glass_keeps_its_normal(tmp_path: Path) -> None:
    away = PLANE | {"normal": (0.0, -2.0, 0.0)}
    assert "plane {\n  vnormalize(<-0.0, 2.0, -0.0>)" in export(tmp_path, objects=[away])
    camera = build().camera.model_dump() | {"inside": "m"}
    assert "plane {\n  vnormalize(<0.0, -2.0, 0.0>)" in export(
        tmp_path, objects=[away], camera=camera, materials={"m": GLASS}, max_depth=1
    )
