from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.fault import STUDENT, Subject
from raytruth.comparisons.faults.variants import all_variants
from raytruth.comparisons.kills.kill_matrix import applies, kills_on, rendered
from raytruth.comparisons.measures.public_gates import GATES
from raytruth.reference_tracer.source.triangle import triangle_normal
from raytruth.reference_tracer.source.vector import normalize
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector

pytestmark = pytest.mark.clause("VER-12")


def endless(a: Vector) -> Vector:
    while True:
        a = (a[0] + 1.0, a[1], a[2])


def failing(a: Vector) -> Vector:
    return a[3]  # type: ignore[misc]


def ten_percent_longer(a: Vector) -> Vector:
    return (1.1 * a[0], 1.1 * a[1], 1.1 * a[2])


SCENE = small_scene(width=12, height=9, extent=3.0, lights=[lamp((2.0, 3.0, 4.0))])


def test_the_original_in_place_of_itself_is_not_killed() -> None:
    (cell,) = kills_on(SCENE, [Subject("itself", "", {"normalize": normalize})]).cells
    assert not cell.fails
    assert (cell.error, cell.gates) == ("", ())


def test_a_fault_is_killed_by_how_far_it_is_off_its_tolerance() -> None:
    (cell,) = kills_on(SCENE, [Subject("longer", "", {"normalize": ten_percent_longer})]).cells
    assert cell.fails
    assert cell.margin > 1000


def test_what_raises_or_hangs_or_writes_no_numbers_is_killed_as_an_error() -> None:
    subjects = [
        Subject("raises", "", {"normalize": failing}),
        Subject("hangs", "", {"normalize": endless}),
        Subject("no number", "", finish=lambda image: image * np.nan),
        Subject("too small", "", finish=lambda image: image[1:]),
    ]
    cells = {cell.subject: cell for cell in kills_on(SCENE, subjects).cells}
    assert all(cell.fails and cell.margin == np.inf for cell in cells.values())
    assert cells["raises"].error == "IndexError: tuple index out of range"
    assert cells["hangs"].error.startswith("TookTooLongError: more than ")
    assert cells["no number"].error == "pixels that are not a number"
    assert cells["no number"].gates == tuple(GATES)
    assert cells["too small"].error == "an image of shape (8, 12, 3)"


def test_a_scene_without_the_function_says_nothing_about_the_fault() -> None:
    without = Subject("triangles", "", {"triangle_normal": triangle_normal})
    assert not applies(without, SCENE)
    assert kills_on(SCENE, [without]).cells == ()
    assert applies(Subject("image", "", finish=lambda image: image), SCENE)


def test_each_output_is_judged_as_it_is_declared() -> None:
    halves = OutputModel("float16")

    def as_halves(image: np.ndarray) -> np.ndarray:
        return image.astype(np.float16).astype(np.float64)

    honest = Subject("honest", "", finish=as_halves, declares=replace(STUDENT, output=halves))
    dishonest = Subject("dishonest", "", finish=as_halves)
    cells = {cell.subject: cell for cell in kills_on(SCENE, [honest, dishonest]).cells}
    assert not cells["honest"].fails
    assert cells["dishonest"].fails


def test_faults_of_first_hits_are_judged_by_first_hits() -> None:
    faults = [all_faults()["depth_along_the_axis"], all_faults()["primitives_numbered_from_one"]]
    right = replace(faults[0], name="right", overrides={"normalize": normalize})
    cells = {cell.subject: cell for cell in kills_on(library_scene("sphere-over-floor"), [*faults, right]).cells}
    assert {name for name, cell in cells.items() if cell.fails} == {fault.name for fault in faults}


def test_float32_is_really_used() -> None:
    single = rendered(SCENE, all_variants()["float32"])
    double = rendered(SCENE, Subject("double", "", declares=replace(STUDENT, output=OutputModel("float64"))))
    assert (single != double).any()
    assert single == pytest.approx(double, abs=1e-5)
