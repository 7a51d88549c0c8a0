from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes.consistency import inconsistencies, parts_of
from raytruth.scenes.scene import Scene
from tests.scenes.scene_files import changed, problems, valid_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.values import Vector

pytestmark = pytest.mark.clause("SCN-1")

PARALLEL = "camera.up: expected a vector that is not parallel to the view from position to look_at, found one that is; "
NO_AREA = "expected three vertices that span an area, found them on one line."


def triangle_has_area(vertices: tuple[Vector, Vector, Vector]) -> bool:
    scene = valid_scene()
    scene["objects"] = [{"shape": "triangle", "vertices": vertices, "material": "red"}]
    return not inconsistencies(parts_of(Scene.model_validate(scene)))


@pytest.mark.clause("NUM-1")
def test_looking_at_the_own_position_is_refused(tmp_path: Path) -> None:
    [problem] = problems(tmp_path, changed(("camera", "look_at"), [0, 1, 5]))
    assert problem.startswith("camera.look_at: expected a point other than the camera's position")


@pytest.mark.clause("CAM-1")
@pytest.mark.parametrize("up", [[0, -1, -5], [0, 0.1, 0.5], [0, 1e-5, 5e-5]])
def test_an_up_vector_along_the_view_is_refused(tmp_path: Path, up: list[float]) -> None:
    scene = changed(("camera", "up"), [component * 1.0 for component in up])
    scene["camera"]["position"] = [component * 3.0 for component in up]
    [problem] = problems(tmp_path, scene)
    assert problem.startswith(PARALLEL)


def test_an_up_vector_almost_along_the_view_is_accepted(tmp_path: Path) -> None:
    assert problems(tmp_path, changed(("camera", "up"), [1e-4, -1, -5])) == []


def test_more_pixels_than_the_limit_are_refused(tmp_path: Path) -> None:
    scene = valid_scene()
    scene["camera"] |= {"width": 4096, "height": 4096}
    assert problems(tmp_path, scene) == []
    scene["camera"]["height"] = 4097
    [problem] = problems(tmp_path, scene)
    assert problem.startswith("camera: expected at most 16777216 pixels, whose results take 1.3 GB of memory")


@pytest.mark.parametrize("place", [("camera", "inside"), ("materials", "bubble", "dielectric", "outside")])
def test_a_medium_must_name_a_dielectric_material(tmp_path: Path, place: tuple[str, ...]) -> None:
    where = ".".join(place)
    assert problems(tmp_path, changed(place, "glass")) == []
    [unknown] = problems(tmp_path, changed(place, "glas"))
    assert unknown.startswith(
        f"{where}: expected the name of one of the scene's materials, found 'glas'; did you mean 'glass'"
    )
    [opaque] = problems(tmp_path, changed(place, "red"))
    assert opaque.startswith(
        f"{where}: expected the name of a material with a dielectric, but 'red' has none; known are"
    )


def test_media_that_surround_each_other_are_refused(tmp_path: Path) -> None:
    found = problems(tmp_path, changed(("materials", "glass", "dielectric", "outside"), "bubble"))
    assert [problem.partition(":")[0] for problem in found] == [
        "materials.glass.dielectric.outside",
        "materials.bubble.dielectric.outside",
    ]
    assert all("a medium that is outside of itself" in problem for problem in found)


def test_a_medium_whose_surroundings_run_in_a_circle_elsewhere_is_not_blamed(tmp_path: Path) -> None:
    scene = changed(("materials", "glass", "dielectric", "outside"), "bubble")
    scene["materials"]["drop"] = {"dielectric": {"index_of_refraction": 1.3, "outside": "glass"}}
    assert not any("materials.drop" in problem for problem in problems(tmp_path, scene))


@pytest.mark.clause("ILL-3")
def test_the_radiometric_convention_has_no_classical_terms(tmp_path: Path) -> None:
    scene = changed(("convention",), "radiometric")
    scene["lights"][0]["falloff"] = "none"
    scene["materials"]["glass"]["dielectric"] |= {"reflectance": [0.1, 0.1, 0.1], "transmittance": [1, 1, 1]}
    found = problems(tmp_path, scene)
    assert [problem.partition(":")[0] for problem in found] == [
        "ambient_light",
        "lights[0].falloff",
        "materials.red.ambient",
        "materials.red.specular",
        "materials.glass.dielectric.reflectance",
    ]
    assert all(problem.endswith("remove it, or set convention to 'whitted'.") for problem in found)
    scene["convention"] = "whitted"
    assert problems(tmp_path, scene) == []


def test_an_ambient_term_under_black_ambient_light_and_a_light_at_the_camera_are_fine(tmp_path: Path) -> None:
    scene = changed(("ambient_light",), [0, 0, 0])
    scene["lights"][0]["position"] = scene["camera"]["position"]
    assert problems(tmp_path, scene) == []


def test_a_face_beyond_the_vertices_is_refused(tmp_path: Path) -> None:
    [problem] = problems(tmp_path, changed(("objects", 2, "faces", 1), [0, 1, 4]))
    assert problem == "objects[2].faces[1]: expected vertex numbers from 0 to 3, found 4."


@pytest.mark.clause("NUM-1")
def test_triangles_without_area_are_refused(tmp_path: Path) -> None:
    scene = changed(("objects", 2, "faces", 1), [0, 1, 1])
    scene["objects"][1]["vertices"] = [[0, 0, 0], [0.25, 0.5, 1], [0.5, 1, 2]]
    assert problems(tmp_path, scene) == [f"objects[1].vertices: {NO_AREA}", f"objects[2].faces[1]: {NO_AREA}"]


COORDINATES = st.floats(-1e12, 1e12, allow_subnormal=True)
POINTS = st.tuples(COORDINATES, COORDINATES, COORDINATES)


@pytest.mark.clause("NUM-1")
@settings(deadline=None)  # the machine may be busy
@given(POINTS, POINTS, POINTS | st.floats(-4, 4))
def test_whether_a_triangle_has_area_is_decided_exactly(first: Vector, second: Vector, third: Vector | float) -> None:
    if isinstance(third, float):  # nearly, and sometimes exactly, on the line of the others
        clipped = (min(max(p + third * (q - p), -1e12), 1e12) for p, q in zip(first, second, strict=True))
        x, y, z = clipped
        third = (x, y, z)
    a, b, c = ([Fraction(component) for component in point] for point in (first, second, third))
    u, v = [q - p for p, q in zip(a, b, strict=True)], [q - p for p, q in zip(a, c, strict=True)]
    cross = [u[i] * v[j] - u[j] * v[i] for i, j in ((0, 1), (1, 2), (2, 0))]
    assert triangle_has_area((first, second, third)) == any(cross)
