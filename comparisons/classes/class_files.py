"""The folder of a graded class: what is kept of each submission, whole or not at all, and found again."""

from __future__ import annotations

import hashlib
import io
import json
import re
import zipfile
from typing import TYPE_CHECKING

import numpy as np
from pydantic import ValidationError

from raytruth.comparisons.classes.archives import SUBMISSION_ROOM, files_below
from raytruth.comparisons.records.class_results import STUDENTS_FOLDER, ClassRow
from raytruth.comparisons.records.grade_results import GRADE_FILE, Grade
from raytruth.comparisons.records.results import Record
from raytruth.reference_tracer.storage.source_digest import source_digest
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.classes.exports import Submission
    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.grading.grade import Occasion

ROW_FILE = "row.json"
PICTURES_FILE = "pictures.npz"
# Folders' names are shown in addresses and lists; file systems take 255 bytes.
_LONGEST_NAME = 60
# What decides how a submission is graded; a change elsewhere moves no grade.
_GRADING_ROOMS = (
    "scenes",
    "reference_tracer",
    "reference_tracer/source",
    "reference_tracer/arithmetics",
    "comparisons/error_models",
    "comparisons/feasible_sets",
    "comparisons/judgement",
    "comparisons/faults",
    "comparisons/grading",
    "comparisons/renderers/program",
)


class KeptRow(Record):
    """A row as it is kept, with what it was graded from and by."""

    given: str
    """A digest of what was handed in, and of all that it was graded by."""
    code: str
    """A digest of the parts of raytruth that grade."""
    row: ClassRow


def code_digest() -> str:
    """Of the parts of raytruth that grade."""
    return source_digest(*_GRADING_ROOMS)


def given_digest(submission: Submission, asked: str) -> str:
    """Of a submission's files, as far as they are looked at, and of what it is graded by (`asked_digest`)."""
    digest = hashlib.sha256(
        f"{asked}\n{submission.student}\n{submission.identifier}\n".encode(errors="surrogateescape")
    )
    for name, path in _files(submission.paths):
        digest.update(f"{name}\n{path.lstat().st_size}\n".encode(errors="surrogateescape"))
        if path.is_file() and not path.is_symlink():
            with path.open("rb") as file:
                digest.update(hashlib.file_digest(file, "sha256").digest())
    return digest.hexdigest()


def asked_digest(assignment: Assignment, scenes: Iterable[str], occasion: Occasion) -> str:
    """Of an assignment, its scenes as JSON, and the occasion, of whose date what students are told by then."""
    told = [assignment.told(occasion.attempt, occasion.date), assignment.tells_private(occasion.date)]
    asked = [assignment.model_dump(mode="json"), sorted(scenes), occasion.stage, occasion.attempt, *told]
    text = json.dumps(asked, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def folder_names(submissions: Iterable[Submission]) -> list[str]:
    """A folder's name for each submission, no two the same, of letters, digits, dots and hyphens alone."""
    names: list[str] = []
    for submission in submissions:
        plain = re.sub(r"[^A-Za-z0-9.-]+", "-", submission.student).strip("-.")
        whole = "\n".join([submission.student, submission.identifier, *(path.name for path in submission.paths)])
        mark = hashlib.sha256(whole.encode(errors="surrogateescape")).hexdigest()[:8]
        is_free = plain.lower() not in {name.lower() for name in names}
        is_plain = plain == submission.student and 0 < len(plain) <= _LONGEST_NAME
        names.append(plain if is_plain and is_free else f"{plain[:_LONGEST_NAME]}-{mark}".lstrip("-"))
    return names


def kept_row(out: Path, folder: str) -> KeptRow | None:
    """What is kept of a submission; None where there is nothing, or nothing that can be read."""
    try:
        text = (out / STUDENTS_FOLDER / folder / ROW_FILE).read_text(encoding="utf-8")
        return KeptRow.model_validate_json(text)
    except (OSError, ValidationError, UnicodeDecodeError):
        return None


def keep_row(out: Path, kept: KeptRow) -> None:
    """Write the row of a submission, last of all its files: what has a row is complete."""
    write_whole(out / STUDENTS_FOLDER / kept.row.folder / ROW_FILE, kept.model_dump_json(indent=1))


def kept_grade(out: Path, folder: str) -> Grade | None:
    """The grade that lies in a submission's folder, if one does that can be read."""
    try:
        return Grade.model_validate_json((out / STUDENTS_FOLDER / folder / GRADE_FILE).read_text(encoding="utf-8"))
    except (OSError, ValidationError, UnicodeDecodeError):
        return None


def keep_pictures(out: Path, folder: str, pictures: Mapping[str, NDArray[np.float32]]) -> None:
    """Write the pictures of a submission, by scene."""
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, **pictures)
    write_whole(out / STUDENTS_FOLDER / folder / PICTURES_FILE, file.getvalue())


def kept_pictures(out: Path, folder: str) -> dict[str, NDArray[np.float32]]:
    """The pictures of a submission; none where they cannot be read."""
    try:
        with np.load(out / STUDENTS_FOLDER / folder / PICTURES_FILE, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return {}


def _files(paths: Iterable[Path]) -> Iterator[tuple[str, Path]]:
    """The files of a submission with their names, as far as there is room: one with more is refused in any case."""
    count = size = 0
    for path in paths:
        is_folder = path.is_dir() and not path.is_symlink()
        for file in files_below(path) if is_folder else [path]:
            count, size = count + 1, size + file.lstat().st_size
            if count > SUBMISSION_ROOM.files or size > SUBMISSION_ROOM.bytes:
                return
            yield file.relative_to(path).as_posix() if is_folder else path.name, file
