"""Reading a results directory: its record, its images, its logs. What is missing or broken gets one sentence."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError
from rich.text import Text

from raytruth.comparisons.records.image_files import ImageError, read_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.comparisons.records.results import RESULTS_FILE, SCHEMA_VERSION, Results, inconsistency

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.pixel_evidence import PixelEvidence
    from raytruth.comparisons.records.renderings import Image

LOG_LINES = 40
"""Enough for a renderer's last words; the whole log lies in the results directory."""

LOG_BYTES = 65_536
"""Read at most from a log's end: a program may have written gigabytes."""


class ReportError(Exception):
    """The report, or a part of it, cannot be made; the message is one sentence."""


def load_results(directory: Path) -> Results:
    """The record of a results directory. Raises ReportError where it is missing, broken or of another version."""
    path = directory / RESULTS_FILE
    document = _read_json(path)
    if not isinstance(document, dict) or "schema_version" not in document:
        raise ReportError(f"{path} is not a results file: expected a JSON object with the key schema_version.")
    version = document["schema_version"]
    if version != SCHEMA_VERSION:
        raise ReportError(
            f"{path} has schema_version {version!r}, but this raytruth reads version {SCHEMA_VERSION}: "
            "run the matrix again, or use the raytruth that wrote it."
        )
    try:
        results = Results.model_validate(document)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
        raise ReportError(f"{path} is broken at {place}: {first['msg']}{more}; run the matrix again.") from error
    wrong = inconsistency(results)
    if wrong is not None:
        raise ReportError(f"{path} {wrong}: run the matrix again.")
    return results


def _read_json(path: Path) -> Any:
    """The parsed document, of any shape."""
    if not path.parent.is_dir():
        raise ReportError(f"There is no results directory {path.parent}: give the one that `raytruth run` wrote.")
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise ReportError(
            f"{path.parent} holds no {RESULTS_FILE}: give the directory that `raytruth run` wrote."
        ) from error
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}.") from error
    except (ValueError, RecursionError) as error:
        raise ReportError(f"{path} is not valid JSON ({error}): run the matrix again.") from error


def read_colours(directory: Path, relative: str) -> Image:
    """A colour image of the results, shape (height, width, 3). Raises ReportError where it is missing or broken."""
    return _read(directory, relative, 3)


def read_values(directory: Path, relative: str) -> Image:
    """A one-channel image of the results, shape (height, width). Raises ReportError where it is missing or broken."""
    return _read(directory, relative, 2)


def read_evidence(directory: Path, relative: str) -> PixelEvidence:
    """What the pixels of a cell are held to. Raises ReportError where it is missing or broken."""
    path = _existing(directory, relative)
    try:
        return read_pixel_evidence(path)
    except ImageError as error:
        raise ReportError(f"The image {error}.") from error


def _existing(directory: Path, relative: str) -> Path:
    path = _inside(directory, relative)
    if not path.is_file():
        raise ReportError(f"The image {relative} is missing.")
    return path


def _read(directory: Path, relative: str, dimensions: int) -> Image:
    path = _existing(directory, relative)
    try:
        image = read_image(path)
    except ImageError as error:
        raise ReportError(f"The image {error}.") from error
    if image.ndim != dimensions:
        raise ReportError(f"The image {relative} has {'one channel' if image.ndim == 2 else 'three channels'}.")
    return image


def read_log(directory: Path, relative: str) -> str:
    """The last lines of a log as plain text, without terminal escapes. Raises ReportError where it is missing."""
    path = _inside(directory, relative)
    try:
        with path.open("rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(0, size - LOG_BYTES))
            tail = file.read(LOG_BYTES)
    except OSError as error:
        raise ReportError(f"The log {relative} cannot be read: {error.strerror}.") from error
    lines = tail.decode("utf-8", errors="replace").splitlines()[-LOG_LINES:]
    return "\n".join(Text.from_ansi(line).plain for line in lines)


def _inside(directory: Path, relative: str) -> Path:
    """The path of a part of the results; a results file from elsewhere must not name files outside its directory."""
    try:
        path = (directory / relative).resolve()
    except ValueError as error:  # a zero byte in the name
        raise ReportError(f"{relative!r} is not the name of a file.") from error
    if not path.is_relative_to(directory.resolve()):
        raise ReportError(f"{relative} lies outside the results directory and is not shown.")
    return path
