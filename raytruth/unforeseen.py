"""What nobody foresaw: written to a log that can be sent to us, and told in one sentence."""

from __future__ import annotations

import datetime
import platform
import shlex
import tempfile
import traceback
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.reference_tracer.storage.cache import named_cache_folder
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Sequence


def sentence_and_log(error: Exception, arguments: Sequence[str]) -> str:
    """Write the log, in the cache folder or else among temporary files; returns the sentence that names it."""
    summary = " ".join(f"{type(error).__name__}: {error}".split())
    log = _written(_text(error, arguments))
    where = f"please report it with the log {log}" if log else "no log of it could be written"
    return f"this is a mistake in raytruth itself ({summary[:LONGEST]}); {where}."


LONGEST = 200
"""Letters of an error's own words: the whole of it is in the log."""


def _text(error: Exception, arguments: Sequence[str]) -> str:
    told = "".join(traceback.format_exception(error))
    system = f"Python {platform.python_version()}, {platform.platform()}"
    return f"raytruth {version('raytruth')}, {system}\n{shlex.join(['raytruth', *arguments])}\n\n{told}"


def _written(text: str) -> Path | None:
    """The path of the log; None where nothing can be written."""
    now = datetime.datetime.now(datetime.UTC).strftime("%Y%m%dT%H%M%S.%f")
    for folder in (named_cache_folder() / "logs", Path(tempfile.gettempdir())):
        log = folder / f"raytruth-{now}.txt"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            write_whole(log, text.encode("utf-8", errors="backslashreplace"))
        except OSError:
            continue
        return log
    return None
