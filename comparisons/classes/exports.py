"""Which submissions there are: in a folder, or in what Gradescope, Moodle, Canvas or GitHub Classroom export."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.archives import is_archive

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

METADATA = "submission_metadata.yml"
"""What Gradescope puts beside the folders of an export."""
# A line for each of a few facts of some thousand students.
_MOST_METADATA = 1 << 24
# Longer names than people have; of a group all of them.
_LONGEST_NAME = 400

# "Ada Lovelace_1234_assignsubmission_file_" is a folder or, before a file's name, a file.
_MOODLE = re.compile(r"(?P<name>.+?)_(?P<identifier>\d+)_assignsubmission_file_?(?P<file>.*)", re.DOTALL)
# "lovelaceada_LATE_1234_567890_tracer.zip": the user's number, then that of the attached file.
_CANVAS = re.compile(r"(?P<name>[^_]+)(_LATE)?_(?P<identifier>\d+)_\d+_(?P<file>.+)", re.DOTALL)
# What `gh classroom clone student-repos` makes: "tracer-submissions/tracer-ada".
_CLASSROOM = "-submissions"


@dataclass(frozen=True)
class Submission:
    """What one student, or one group, has handed in."""

    student: str
    paths: tuple[Path, ...]
    """Files, archives or one folder."""
    identifier: str = ""
    """By which the platform knows the student, for uploading grades."""
    email: str = ""


def submissions_in(folder: Path) -> list[Submission]:
    """The submissions in a folder, by the layout that it has, in the order of their names.

    Hidden files, and files that are no archives and of no platform's layout, are no submissions.
    """
    return [
        replace(it, student=_shown(it.student), identifier=_shown(it.identifier), email=_shown(it.email))
        for it in _found_in(folder)
    ]


def _shown(text: str) -> str:
    """A name as text of a length that can be shown: of files it may be any bytes, of metadata a megabyte."""
    return text[:_LONGEST_NAME].encode(errors="surrogateescape").decode(errors="replace")


def _found_in(folder: Path) -> list[Submission]:
    """The submissions with names as they are."""
    entries = sorted(path for path in folder.iterdir() if not path.name.startswith((".", "__MACOSX")))
    folders = [path for path in entries if path.is_dir()]
    if len(entries) == 1 and folders and (entries[0] / METADATA).is_file():
        return _found_in(entries[0])
    if (folder / METADATA).is_file():
        return list(_of_gradescope(folder))
    for pattern in (_MOODLE, _CANVAS):
        matches = [(path, match) for path in entries if (match := pattern.fullmatch(path.name))]
        if matches and len(matches) == len(entries):
            return _by_identifier(matches)
    prefix = f"{folder.resolve().name.removesuffix(_CLASSROOM)}-"
    if folder.resolve().name.endswith(_CLASSROOM) and all(path.name.startswith(prefix) for path in folders):
        return [Submission(path.name.removeprefix(prefix), (path,), path.name.removeprefix(prefix)) for path in folders]
    return [Submission(_stem(path), (path,)) for path in entries if path.is_dir() or is_archive(path)]


def given_name(submission: Submission, path: Path) -> str:
    """What the student called a file that a platform has put names and numbers before."""
    for pattern in (_MOODLE, _CANVAS):
        match = pattern.fullmatch(path.name)
        if match is not None and match["identifier"] == submission.identifier and match["file"]:
            return match["file"]
    return path.name


def _by_identifier(matches: list[tuple[Path, re.Match[str]]]) -> list[Submission]:
    """One submission of each student, who may have handed in several files."""
    paths: dict[tuple[str, str], list[Path]] = {}
    for path, match in matches:
        paths.setdefault((match["name"], match["identifier"]), []).append(path)
    return [Submission(name, tuple(own), identifier) for (name, identifier), own in paths.items()]


def _of_gradescope(folder: Path) -> Iterator[Submission]:
    """The folders of an export, with the names that its metadata has; those without a folder have handed in nothing."""
    with (folder / METADATA).open(encoding="utf-8", errors="replace") as file:
        people = _submitters(file.read(_MOST_METADATA))
    for path in sorted(it for it in folder.iterdir() if it.is_dir() and not it.name.startswith(".")):
        own = people.get(path.name, [])
        names, numbers, emails = (", ".join(it[key] for it in own if it.get(key)) for key in ("name", "sid", "email"))
        yield Submission(names or path.name, (path,), numbers or path.name, emails)


def _submitters(text: str) -> dict[str, list[dict[str, str]]]:
    """Who has handed in which folder: the few lines of Gradescope's YAML that tell it, each read for itself.

    submission_123:
      :submitters:
      - :name: Ada Lovelace
        :sid: '1234'
        :email: ada@example.edu
    """
    found: dict[str, list[dict[str, str]]] = {}
    own: list[dict[str, str]] = []
    is_inside = False
    for line in text.splitlines():
        if match := re.fullmatch(r"([\w-]+):\s*", line):
            own = found.setdefault(match[1], [])
            is_inside = False
        elif match := re.fullmatch(r"  :(\w+):.*", line):
            is_inside = match[1] == "submitters"
        elif is_inside and (
            match := re.fullmatch(r"\s+(- |  )?:(name|sid|email):\s*(.*?)\s*", line)
            or re.fullmatch(r"\s*(- ):(name|sid|email):\s*(.*?)\s*", line)
        ):
            if (match[1] or "").startswith("-") or not own:
                own.append({})
            own[-1][match[2]] = match[3].strip("'\"")
    return found


def _stem(path: Path) -> str:
    """The name of a folder, or of an archive without its endings."""
    return path.name if path.is_dir() else re.sub(r"(\.tar)?\.\w+$", "", path.name)
