"""What Gradescope tells of a submission in `submission_metadata.json` ("Autograder Specifications")."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

# Results of a hundred earlier attempts, each with its log, take less.
LARGEST_METADATA = 16 * 2**20
# Of a submission's digest, so that seeds are told apart: more than a course has submissions.
SEED_BYTES = 3


class MetadataError(Exception):
    """The file cannot be used; the message is one sentence."""


@dataclass(frozen=True)
class SubmissionMetadata:
    """What grading needs of it."""

    attempt: int
    """From 1. Earlier attempts that raytruth could not grade do not count."""
    seed: int
    """Follows from the submission's number, so that a second run draws the same scenes."""
    due: datetime | None
    """The last date at which this student may hand in, extensions included."""


def read_submission_metadata(path: Path) -> SubmissionMetadata:
    """Raises MetadataError where there is no such file, or it holds something else."""
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_METADATA + 1)
        if len(content) > LARGEST_METADATA:
            raise MetadataError(f"{path}: expected at most {LARGEST_METADATA // 2**20} MiB, found more.")
        data = json.loads(content)
    except OSError as error:
        raise MetadataError(f"{path}: expected Gradescope's submission_metadata.json, but {error.strerror}.") from error
    except (ValueError, RecursionError) as error:
        raise MetadataError(f"{path}: expected valid JSON, as Gradescope writes it.") from error
    if not isinstance(data, dict) or not isinstance(data.get("id"), int):
        raise MetadataError(f"{path}: id: expected the number of a submission, found none.")
    earlier = data.get("previous_submissions") or []
    if not isinstance(earlier, list):
        raise MetadataError(f"{path}: previous_submissions: expected a list.")
    digest = hashlib.sha256(str(data["id"]).encode()).digest()
    return SubmissionMetadata(
        attempt=1 + sum(map(_was_graded, earlier)),
        seed=int.from_bytes(digest[:SEED_BYTES]),
        due=max(_due_dates(data.get("assignment"), path), default=None),
    )


def _was_graded(earlier: Any) -> bool:
    """Whether an earlier attempt got a grade: where raytruth itself failed, its results have no score."""
    results = earlier.get("results") if isinstance(earlier, dict) else None
    return isinstance(results, dict) and results.get("score") is not None


def _due_dates(assignment: Any, path: Path) -> list[datetime]:
    stated = assignment if isinstance(assignment, dict) else {}
    found = []
    for key in ("due_date", "late_due_date"):
        if stated.get(key) is not None:
            found.append(parsed_date(str(stated[key]), f"{path}: assignment.{key}"))
    return found


def parsed_date(text: str, place: str) -> datetime:
    """A date in ISO 8601 with its offset from UTC. Raises MetadataError, which names the place."""
    try:
        date = datetime.fromisoformat(text)
    except ValueError:
        date = None
    if date is None or date.tzinfo is None:
        raise MetadataError(
            f"{place}: expected a date with time and offset from UTC, as 2026-12-01T23:59:00+01:00, found {text!a}."
        )
    return date
