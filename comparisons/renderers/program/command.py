"""The command of a program: its words as they are run, and the files that they name."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# Of files and folders beside a script. A tracer has dozens; where there are more, as in somebody's home, most is not of
# the program, and to look through all of it would take longer than to render.
MOST_LOOKED_AT = 10_000


def filled_command(
    command: Sequence[str], folder: Path, environment: Mapping[str, str], values: Mapping[str, object]
) -> list[str]:
    """The words to run: with values in place of placeholders, and with absolute paths of the files that they name.

    `folder` is where relative paths start. The first word is the program, found as a shell finds it.
    """
    words = [_filled(_located(word, folder), values) for word in command]
    return [_program(command[0], folder, environment) or words[0], *words[1:]]


def missing_program(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> str | None:
    """The sentence about a program that there is none of, or that cannot be run; None if all is well."""
    if not command or _program(command[0], folder, environment) is not None:
        return None
    word = command[0]
    if os.sep not in word:
        beside = f"; did you mean './{word}'?" if (folder / word).is_file() else "; install it, or give its path."
        return f"expected a program, found none called '{word}' on the PATH{beside}"
    if (folder / word).is_file():
        return f"expected a program, but {folder / word} may not be executed; chmod +x it."
    return f"expected a program, found none at {folder / word}; build it first."


def counted_files(
    command: Sequence[str], folder: Path, environment: Mapping[str, str], patterns: Sequence[str] | None
) -> list[Path]:
    """The files of which a change makes another program: those that the words name, and those that they may read.

    Of folders that they name these are the files in them. Beyond these it is what the patterns match, from `folder`;
    without patterns (None) all of a script's kind that lie beside it in `folder` or below, which it may import.
    """
    found = named_files(command, folder, environment)
    if patterns is not None:
        matched = [path for pattern in patterns for path in files_matching(pattern, folder)]
    else:
        scripts = [path for path in found if path.suffix and path.is_relative_to(folder.resolve())]
        matched = [path for script in scripts for path in _of_its_kind(script)]
    return list(dict.fromkeys([*found, *matched]))


def files_matching(pattern: str, folder: Path) -> list[Path]:
    """The files that a pattern matches, as a shell's with `**` for folders of any depth."""
    return sorted(path for path in folder.resolve().glob(pattern) if path.is_file())


def named_files(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> list[Path]:
    """The files that the words name, and those that lie in folders that they name: what a rebuilt program changes."""
    found: list[Path] = []
    program = _program(command[0], folder, environment)
    for word in ([program] if program else []) + [_located(word, folder) for word in command[1:]]:
        path = Path(word)
        if path.is_absolute() and path.is_file():
            found.append(path)
        elif path.is_absolute() and path.is_dir():
            found += sorted(file for file in path.iterdir() if file.is_file())
    return found


def _of_its_kind(script: Path) -> list[Path]:
    """All files with its ending in its folder and below, hidden folders left out; none where too much lies there."""
    found: list[Path] = []
    looked_at = 0
    for folder, folders, files in os.walk(script.parent):
        folders[:] = [name for name in folders if not name.startswith(".")]
        looked_at += len(folders) + len(files)
        if looked_at > MOST_LOOKED_AT:
            return []
        found += [Path(folder) / name for name in files if name.endswith(script.suffix)]
    return sorted(path for path in found if path.is_file())


def _program(word: str, folder: Path, environment: Mapping[str, str]) -> str | None:
    """The absolute path of the program; a name without a slash is looked for on the PATH."""
    if os.sep in word:
        path = folder.resolve() / word
        return str(path) if path.is_file() and os.access(path, os.X_OK) else None
    return shutil.which(word, path=environment.get("PATH"))


def _located(word: str, folder: Path) -> str:
    """The absolute path where a word names a file beside the declaration, or a folder and looks like a path."""
    path = folder.resolve() / word
    try:
        is_named = path.is_file() or ((os.sep in word or word == ".") and path.is_dir())
    except (OSError, ValueError):  # longer than any path, say
        return word
    return str(path) if word and is_named else word


def _filled(word: str, values: Mapping[str, object]) -> str:
    """All placeholders at once, so that braces in a path stay what they are."""
    return re.sub(r"\{(\w+)\}", lambda match: str(values[match[1]]), word)
