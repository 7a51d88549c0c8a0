"""Assignments as commands are given them, and what is written for services that grade by them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.bundle import BundleError, write_bundle
from raytruth.comparisons.grading.assignment_file import AssignmentError, assignment_path, load_assignment
from raytruth.errors import UsageError
from raytruth.output import say

if TYPE_CHECKING:
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.records.class_results import Service


def opened_assignment(name_or_path: str) -> tuple[Assignment, Path]:
    """An assignment and its file. Raises UsageError with every mistake of it."""
    try:
        path = assignment_path(name_or_path)
        return load_assignment(path), path
    except AssignmentError as error:
        raise UsageError(str(error)) from error


def write_service_bundle(service: Service, given: tuple[str, ...], assignment: str, out: Path | None) -> int:
    """Write a bundle with the assignment that is given, and say what is in it. Raises UsageError."""
    if len(given) > 1:
        raise UsageError(f"--bundle: expected one assignment, found {len(given)}.")
    opened, path = opened_assignment(given[0] if given else assignment)
    folder = out or Path(f"{opened.name}-{service}")
    try:
        written = write_bundle(service, opened, path, folder)
    except BundleError as error:
        raise UsageError(str(error)) from error
    for file in written:
        say(f"{folder / file}")
    return 0
