"""A grade as HTML pages, one for the student and one for the teacher, each complete by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

from raytruth.reports import wording
from raytruth.reports.grade_text import diagnosis_sentence, headline, points, scene_sentence

if TYPE_CHECKING:
    from raytruth.comparisons.records.grade_results import Grade

STUDENT_PAGE = "student.html"
TEACHER_PAGE = "teacher.html"


def grade_page(grade: Grade, *, for_teacher: bool) -> str:
    """The page; for a student, `grade` is what the student may be told."""
    loader = PackageLoader("raytruth.reports")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: wording.printable(value) if type(value) is str else value,
    )
    environment.filters["points"] = points
    environment.filters["sentence"] = scene_sentence
    environment.filters["proof"] = diagnosis_sentence
    return environment.get_template("grade.html.jinja").render(
        grade=grade,
        headline=headline(grade),
        for_teacher=for_teacher,
        style=loader.get_source(environment, "report.css")[0],
    )
