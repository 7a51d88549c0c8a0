"""Mistakes switched on in the example tracer in Python, each written by hand as a student makes it.

They are edits of the student's own text, not of the tracer's source, and were written without the catalogue's edits.
`python -m tests.comparisons.grading.student_mistakes` grades them all and prints the table of docs/teaching.md.
"""

from __future__ import annotations

import os
import shutil
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.comparisons.grading.assignment_file import STARTING, assignment_path, load_assignment
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.grading.grade import Occasion, grade_submission
from raytruth.programs import program_of_file
from tests.rooms import ROOT

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade

EXAMPLE = ROOT / "examples" / "tracers" / "python"


@dataclass(frozen=True)
class StudentMistake:
    """A line of the example that is written otherwise, and what a diagnosis should call it."""

    name: str
    old: str
    new: str
    known_as: tuple[str, ...]
    """The catalogue's faults, or the global mistakes, that this is; none where the catalogue has no such fault."""
    file: str = "tracer.py"


MISTAKES = (
    StudentMistake(
        "shadows forgotten",
        "if cosine <= 0 or is_hidden(scene, Ray(point, to_light, reflected.leaves), distance):",
        "if cosine <= 0:",
        ("no_shadow_rays",),
    ),
    StudentMistake(
        "shadows of things behind the light",
        "any(distance < light_distance for distance, _ in hits(scene, ray))",
        "any(distance < inf for distance, _ in hits(scene, ray))",
        ("shadow_ray_not_limited",),
    ),
    StudentMistake("pi forgotten", "cosine / pi if scene.is_radiometric else cosine", "cosine", ("no_pi",)),
    StudentMistake(
        "pi everywhere",
        "cosine / pi if scene.is_radiometric else cosine",
        "cosine / pi",
        ("pi_in_the_classical_equation",),
    ),
    StudentMistake(
        "only one light", "for light in scene.lights:", "for light in scene.lights[:1]:", ("first_light_only",)
    ),
    StudentMistake(
        "absolute cosine",
        "cosine = dot(normal, to_light)",
        "cosine = abs(dot(normal, to_light))",
        ("lit_through_the_surface",),
    ),
    StudentMistake(
        "far side of spheres",
        "    if -b - root > 0:\n        return -b - root  # SPH-1\n",
        "",
        ("farther_root_of_a_sphere",),
    ),
    StudentMistake("half triangles doubled", "if v < 0 or u + v > 1:", "if v < 0 or v > 1:", ("parallelogram",)),
    StudentMistake(
        "one over the distance", "quadratic * distance * distance", "quadratic * distance", ("one_over_distance",)
    ),
    StudentMistake(
        "attenuation left out",
        "return 1 if light.is_clamped and divisor <= 1 else 1 / divisor",
        "return 1",
        ("no_falloff",),
    ),
    StudentMistake("Blinn everywhere", "if material.is_blinn:", "if True:", ("blinn_for_phong",)),
    StudentMistake("Phong everywhere", "if material.is_blinn:", "if False:", ("phong_for_blinn",)),
    StudentMistake(
        "highlight weakened by the cosine",
        "max(highlight, 0) ** material.exponent, material.specular",
        "cosine * max(highlight, 0) ** material.exponent, material.specular",
        ("highlight_times_cosine",),
    ),
    StudentMistake(
        "reflection without the two",
        "scale(2 * dot(ray.direction, normal), normal)",
        "scale(dot(ray.direction, normal), normal)",
        ("reflection_without_the_two",),
    ),
    StudentMistake(
        "one bounce fewer",
        "camera.inside, scene.max_depth)",
        "camera.inside, scene.max_depth - 1)",
        ("one_bounce_too_few",),
    ),
    StudentMistake(
        "one bounce more",
        "camera.inside, scene.max_depth)",
        "camera.inside, scene.max_depth + 1)",
        ("one_bounce_too_many",),
    ),
    StudentMistake(
        "indices upside down",
        "eta = glass.index / outer if enters else outer / glass.index",
        "eta = outer / glass.index if enters else glass.index / outer",
        ("inverted_index_ratio",),
    ),
    StudentMistake(
        "always as if entering",
        "eta = glass.index / outer if enters else outer / glass.index",
        "eta = glass.index / outer",
        ("same_ratio_on_both_sides",),
    ),
    StudentMistake(
        "dark total reflection",
        "return multiply(glass.reflectance, mirrored) if glass.reflectance else mirrored",
        "return BLACK",
        ("total_reflection_is_black",),
    ),
    StudentMistake(
        "radiance not scaled",
        "transmitted = (1 - fresnel) / (eta * eta) if scene.is_radiometric else 1 - fresnel",
        "transmitted = 1 - fresnel",
        ("radiance_not_scaled",),
    ),
    StudentMistake(
        "Schlick",
        "fresnel = (((c - g) / (c + g)) ** 2 + ((eta * eta * c - g) / (eta * eta * c + g)) ** 2) / 2",
        "normal_incidence = ((eta - 1) / (eta + 1)) ** 2\n"
        "        fresnel = normal_incidence + (1 - normal_incidence) * (1 - (c if eta > 1 else g / eta)) ** 5",
        ("schlick", "schlick_by_the_incident_cosine"),
    ),
    StudentMistake(
        "absorption forgotten",
        "    if medium is None or medium.dielectric.absorption is None:\n        return total\n",
        "    return total\n",
        ("nothing_absorbed",),
    ),
    StudentMistake(
        "linear absorption", "exp(-sigma * distance)", "max(0.0, 1 - sigma * distance)", ("linear_absorption",)
    ),
    StudentMistake(
        "gradient upside down", "k = (direction[1] + 1) / 2", "k = (1 - direction[1]) / 2", ("gradient_upside_down",)
    ),
    StudentMistake(
        "normals not turned",
        "        normal = scale(-1, normal)\n",
        "        pass\n",
        ("normal_not_turned_to_the_viewer",),
    ),
    StudentMistake(
        "mirrored",
        "x = (column + 0.5 - camera.width / 2) * camera.pixel",
        "x = -(column + 0.5 - camera.width / 2) * camera.pixel",
        ("mirrored",),
    ),
    StudentMistake(
        "rows in the wrong order",
        "for row in reversed(range(camera.height)):",
        "for row in range(camera.height):",
        ("upside_down",),
    ),
    StudentMistake(
        "corners of pixels",
        "column + 0.5 - camera.width / 2) * camera.pixel\n    y = (row + 0.5 -",
        "column - camera.width / 2) * camera.pixel\n    y = (row -",
        ("half_a_pixel_top_left",),
    ),
    StudentMistake(
        "gamma for beauty",
        "values += radiance(scene, camera_ray(camera, column, row), camera.inside, scene.max_depth)",
        "values += (value ** (1 / 2.2) for value in "
        "radiance(scene, camera_ray(camera, column, row), camera.inside, scene.max_depth))",
        ("power_in_a_linear_file",),
    ),
    StudentMistake(
        "blue first",
        "values += radiance(scene, camera_ray(camera, column, row), camera.inside, scene.max_depth)",
        "values += radiance(scene, camera_ray(camera, column, row), camera.inside, scene.max_depth)[::-1]",
        ("channels_as_BGR",),
    ),
    StudentMistake(
        "normals bent upward",
        "normal = unit(subtract(point, primitive.center))",
        "normal = unit(add(subtract(point, primitive.center), (0, 0.2, 0)))",
        (),
    ),
    StudentMistake(
        "reflections fade with the square of the way",
        "multiply(material.mirror, radiance(",
        "multiply(scale(1 / (1 + distance * distance), material.mirror), radiance(",
        (),
    ),
    StudentMistake("lights blink by their order", "for light in scene.lights:", "for light in scene.lights[::-2]:", ()),
)


def write_submission(mistakes: tuple[StudentMistake, ...], folder: Path) -> Path:
    """Copy the example with these mistakes into a folder, and return its declaration's path.

    Raises ValueError where the example does not hold what a mistake alters exactly once.
    """
    for path in EXAMPLE.iterdir():
        if path.is_file():
            shutil.copy(path, folder / path.name)
    for mistake in mistakes:
        path = folder / mistake.file
        text = path.read_text(encoding="utf-8")
        if text.count(mistake.old) != 1:
            raise ValueError(f"{mistake.name}: found {mistake.old!r} {text.count(mistake.old)} times")
        path.write_text(text.replace(mistake.old, mistake.new), encoding="utf-8")
    return folder / "tracer.toml"


def table_row(mistake: StudentMistake, grade: Grade) -> str:
    """A row of the table: what was told of a mistake, and where the true name stands in it."""
    told = [it.name for it in grade.mistakes] + [it.fault for it in grade.diagnosis]
    place = next((str(number) for number, name in enumerate(told, start=1) if name in mistake.known_as), "-")
    proved = [f"{it.explained} of {it.looked_at}" for it in grade.diagnosis if it.fault == told[0]] or ["-"]
    is_known = not grade.unexplained or any(it.is_whole for it in grade.diagnosis)
    first = f"`{told[0]}`" if told else "-"
    known_as = ", ".join(f"`{name}`" for name in mistake.known_as) or "not in the catalogue"
    verdict = "" if is_known else "no known mistake explains all of it"
    return f"| {mistake.name} | {known_as} | {first} | {proved[0]} | {place} | {verdict} |"


def main() -> None:
    """Grade every mistake, and print its row as soon as it is known."""
    path = assignment_path(STARTING)
    assignment = load_assignment(path)
    topics = scenes_of(assignment, path.parent)
    print("| mistake | in the catalogue | told first | proved | place of the true one | |\n|---|---|---|--:|--:|---|")
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        for mistake in MISTAKES:
            with TemporaryDirectory() as folder:
                program = program_of_file(write_submission((mistake,), Path(folder)))
                print(table_row(mistake, grade_submission(program, assignment, topics, Occasion(), pool)), flush=True)


if __name__ == "__main__":
    main()
