"""The command of a program: its words as they are run, and the files that they name."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


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
