from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from raytruth.scenes.consistency import inconsistencies, parts_of
from raytruth.scenes.families.catalogue import FAMILIES, family
from raytruth.scenes.shapes import Mesh, Sphere, Triangle

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("SCN-7")

SPECIFICATION = (Path(__file__).parents[2] / "docs" / "spec.md").read_text(encoding="utf-8")
MEMBERS = [(name, parameter) for name, members in FAMILIES.items() for parameter in members.parameters]


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize(("name", "parameter"), MEMBERS)
def test_every_member_is_a_scene_that_the_format_accepts(name: str, parameter: float, seed: int) -> None:
    assert inconsistencies(parts_of(family(name, parameter, seed))) == []


@pytest.mark.parametrize("name", FAMILIES)
def test_a_family_says_what_the_specification_demands_by_clauses_that_exist(name: str) -> None:
    clauses = re.findall(r"\b[A-Z]+-\d+\b", FAMILIES[name].about)
    assert clauses
    assert [clause for clause in clauses if f"**{clause}**" not in SPECIFICATION] == []


@pytest.mark.parametrize("name", FAMILIES)
def test_a_seed_repeats_a_scene_and_another_changes_it(name: str) -> None:
    parameter = FAMILIES[name].parameters[-1]  # the first may be a symmetric one, such as a light in the centre
    assert family(name, parameter, 3) == family(name, parameter, 3)
    assert family(name, parameter, 3) != family(name, parameter, 4)


@pytest.mark.parametrize("name", FAMILIES)
def test_the_parameter_changes_the_scene_and_ties_are_parameters(name: str) -> None:
    members = FAMILIES[name]
    scenes = [family(name, parameter) for parameter in members.parameters]
    assert all(scenes[a] != scenes[b] for a in range(len(scenes)) for b in range(a))
    assert members.ties <= set(members.parameters)


def test_an_unknown_family_is_refused() -> None:
    with pytest.raises(KeyError):
        family("no-such-family", 1.0)


def first_sphere(scene: Scene) -> Sphere:
    shape = scene.objects[0]
    assert isinstance(shape, Sphere)
    return shape


def exact_square(vector: tuple[float, float, float]) -> Fraction:
    return sum((Fraction(part) ** 2 for part in vector), start=Fraction(0))


def test_at_parameter_0_the_tangent_family_has_a_ray_at_exactly_the_radius() -> None:
    assert first_sphere(family("tangent", 0.0)).radius == 5.0
    assert first_sphere(family("tangent", 1e-12)).radius < 5.0 < first_sphere(family("tangent", -1e-12)).radius


def test_the_seeds_of_the_tangent_family_look_along_every_axis_from_both_sides() -> None:
    positions = {family("tangent", 0.0, seed).camera.position for seed in range(6)}
    assert len(positions) == 6
    assert all(sorted(map(abs, position)) == [0.0, 0.0, 8.0] for position in positions)


@pytest.mark.parametrize("ulps", range(-8, 9))
def test_the_family_at_the_critical_angle_is_off_by_that_many_ulp(ulps: int) -> None:
    scene = family("critical-angle", float(ulps))
    dielectric = scene.materials["glass"].dielectric
    assert dielectric is not None
    # The view has the direction (4, 3, 0)/5, and so the cosine 3/5; g² = 1/n² - 1 + 9/25.
    assert tuple(-2 * part for part in scene.camera.position) == (8.0, 6.0, 0.0)
    index = Fraction(dielectric.index_of_refraction)
    assert index == Fraction(5, 4) + ulps * Fraction(2) ** -52
    discriminant = 1 / index**2 - 1 + Fraction(9, 25)
    assert (discriminant > 0) - (discriminant < 0) == (ulps < 0) - (ulps > 0)


@pytest.mark.parametrize("parameter", FAMILIES["sphere-size"].parameters)
def test_the_nearest_point_of_a_sphere_of_any_size_is_at_distance_1(parameter: float) -> None:
    shape = first_sphere(family("sphere-size", parameter))
    assert shape.radius == parameter
    # The centre's coordinate is rounded once.
    assert abs(-Fraction(shape.center[2]) - Fraction(parameter) - 1) <= Fraction(shape.center[2]) * -(
        Fraction(2) ** -53
    )


@pytest.mark.parametrize("parameter", FAMILIES["camera-near-surface"].parameters)
def test_the_camera_near_a_surface_is_on_the_side_that_the_parameter_says(parameter: float) -> None:
    position = family("camera-near-surface", parameter).camera.position
    height = exact_square(position) - 1
    assert (height > 0) - (height < 0) == (parameter > 0) - (parameter < 0)


@pytest.mark.parametrize("corners", [4, 8, 16, 32])
def test_a_fan_is_closed_and_its_triangles_share_one_vertex(corners: int) -> None:
    (mesh,) = family("fan", float(corners)).objects
    assert isinstance(mesh, Mesh)
    assert len(mesh.faces) == corners == len(set(mesh.vertices)) - 1
    assert {face[0] for face in mesh.faces} == {0}
    assert sorted(face[1] for face in mesh.faces) == sorted(face[2] for face in mesh.faces) == [*range(1, corners + 1)]


@pytest.mark.parametrize("parameter", FAMILIES["needle"].parameters)
def test_a_needle_has_its_width_to_a_ten_thousandth(parameter: float) -> None:
    (needle,) = family("needle", parameter).objects
    assert isinstance(needle, Triangle)
    a, b, _ = needle.vertices
    # Coordinates of about 0.3 are rounded to 2^-54, a 2e-4 th of the narrowest.
    assert b[0] - a[0] == pytest.approx(parameter, rel=2e-4)
    assert a[1:] == b[1:]
