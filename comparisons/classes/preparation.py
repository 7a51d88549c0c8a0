"""From what a student handed in to a program that can be run: unpacked, found, and built within limits."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.archives import unpack
from raytruth.comparisons.classes.exports import given_name
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers.program.adapter import MEBIBYTE, ProgramRenderer
from raytruth.comparisons.renderers.program.command import command_and_format, missing_program
from raytruth.comparisons.renderers.program.declaration_file import (
    DeclarationError,
    checked_declaration,
    load_declaration,
)
from raytruth.comparisons.sandboxes.sandbox import Sandbox

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.classes.exports import Submission
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.sandboxes.sandbox import Rung

DECLARATION = "tracer.toml"
"""The file in which a submission says how it is run, unless the assignment does."""


class NoProgramError(Exception):
    """A submission holds nothing that can be run; the message is one sentence."""


class BuildError(Exception):
    """A submission cannot be built; the message is one sentence with the end of its log."""


def prepared(submission: Submission, folder: Path, assignment: Assignment, rung: Rung | None) -> ProgramRenderer:
    """The program of a submission, unpacked into `folder` and built, in a sandbox unless `rung` is None.

    Raises ArchiveError, NoProgramError and BuildError, each with its sentence.
    """
    source = folder / "source"
    for path in submission.paths:
        target = source if len(submission.paths) == 1 else source / given_name(submission, path)
        unpack(path, target)
    root = _root(source)
    # What is in an archive in the archive, as where a platform packs what students pack.
    archives = [path for path in root.iterdir() if path.is_file() and path.name.lower().endswith((".zip", ".tar.gz"))]
    if len(archives) == 1 and not (root / DECLARATION).exists():
        unpack(archives[0], folder / "inner")
        root = _root(folder / "inner")
    if assignment.build:
        _build(root, assignment, rung)
    return _program(root, assignment)


def _root(folder: Path) -> Path:
    """The folder, or the one in it where there is nothing else. Raises NoProgramError where nothing was handed in."""
    folder.mkdir(parents=True, exist_ok=True)
    entries = list(folder.iterdir())
    if not entries:
        raise NoProgramError("Nothing was handed in: no file is left of it.")
    return _root(entries[0]) if len(entries) == 1 and entries[0].is_dir() else folder


def _build(root: Path, assignment: Assignment, rung: Rung | None) -> None:
    try:
        run_isolated(
            shlex.split(assignment.build),
            root,
            seconds=assignment.build_seconds,
            memory_bytes=assignment.limits.memory_mib * MEBIBYTE,
            file_bytes=assignment.limits.output_mib * MEBIBYTE,
            sandbox=None if rung is None else Sandbox(rung),
        )
    except RendererError as error:
        raise BuildError(f"It could not be built: {error}.") from error


def _program(root: Path, assignment: Assignment) -> ProgramRenderer:
    """As the assignment runs it, else as the submission says. Raises NoProgramError."""
    try:
        if assignment.run:
            data = {"name": "submission", **command_and_format(shlex.split(assignment.run))}
            declaration = checked_declaration(data, "run")
        else:
            declaration = load_declaration(root / DECLARATION)
    except DeclarationError as error:
        told = " ".join(it.replace(f"{root}/", "") for it in error.problems)
        raise NoProgramError(f"It does not say how it is run: {told}") from error
    missing = missing_program(declaration.command, root, declaration.environment)
    if missing is not None:
        raise NoProgramError(f"Its program is not there: {missing.replace(f'{root}/', '')}")
    return ProgramRenderer(declaration, root, f"--renderer-file {DECLARATION}")
