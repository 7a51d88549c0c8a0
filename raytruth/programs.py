"""Programs of users as renderers: those that options name, and the file that one starts from."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.command import files_matching, missing_program
from raytruth.comparisons.renderers.program.declaration_file import (
    DeclarationError,
    checked_declaration,
    load_declaration,
)
from raytruth.errors import UsageError
from raytruth.scenes.wording import quoted

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

FILE_OPTION = "--renderer-file"
COMMAND_OPTION = "--renderer-command"


def programs_of(commands: Iterable[str], files: Iterable[Path]) -> dict[str, ProgramRenderer]:
    """The programs that both options name, each by its name.

    Raises UsageError with every mistake of all of them, and where two have one name or one has that of a renderer of
    ours.
    """
    problems: list[str] = []
    programs: dict[str, ProgramRenderer] = {}
    for read, given in [*((_of_command, text) for text in commands), *((program_of_file, path) for path in files)]:
        try:
            program = read(given)  # type: ignore[operator]  # each reads what stands beside it
        except DeclarationError as error:
            problems += error.problems
            continue
        if program.name in programs or program.name in all_renderers():
            told = "is given twice" if program.name in programs else "is one of raytruth's own; choose another"
            problems.append(f"{program.chosen_by}: the name {quoted(program.name)} {told}.")
        problems += missing_programs(program)
        programs[program.name] = program
    if problems:
        raise UsageError("\n".join(problems))
    return programs


def missing_programs(program: ProgramRenderer) -> list[str]:
    """A sentence for each command whose program is not there, and for each pattern that no file matches."""
    declared = program.declaration
    commands = {"command": declared.command, "version": declared.version}
    told = {key: missing_program(words, program.folder, declared.environment) for key, words in commands.items()}
    unmatched = [pattern for pattern in declared.files or () if not files_matching(pattern, program.folder)]
    return [
        *(f"{program.chosen_by}: {key}[0]: {sentence}" for key, sentence in told.items() if sentence is not None),
        *(
            f"{program.chosen_by}: files: expected a pattern of files in {program.folder}, found none for {quoted(it)}."
            for it in unmatched
        ),
    ]


def program_of_file(path: Path) -> ProgramRenderer:
    """The program that a TOML file declares. Raises DeclarationError."""
    declaration = load_declaration(path)
    return ProgramRenderer(declaration, path.parent.resolve(), f"{FILE_OPTION} {shlex.quote(str(path))}")


def _of_command(text: str) -> ProgramRenderer:
    """The program in `NAME=COMMAND…`, of which all else is as it is by default. Raises DeclarationError."""
    name, equals, command = text.partition("=")
    if not equals:
        told = f"expected NAME=COMMAND as in 'mine=./tracer {{scene}} {{output}}', found {quoted(text)}"
        raise DeclarationError([f"{COMMAND_OPTION}: {told}."])
    try:
        words = shlex.split(command)
    except ValueError as error:
        told = f"expected words as a shell takes them, found {quoted(command)} ({error})"
        raise DeclarationError([f"{COMMAND_OPTION}: {told}."]) from error
    data: dict[str, Any] = {"name": name.strip(), **_with_format(words)}
    declaration = checked_declaration(data, COMMAND_OPTION)
    return ProgramRenderer(declaration, Path.cwd(), f"{COMMAND_OPTION} {shlex.quote(text)}")


def _with_format(words: Sequence[str]) -> dict[str, Any]:
    """The command, and the format that an ending of {output} names, as in `{output}.pfm`."""
    endings = {match[1] for word in words for match in re.finditer(r"\{output\}\.(\w+)", word)}
    command = [re.sub(r"\{output\}\.\w+", "{output}", word) for word in words]
    return {"command": command, **({"writes": min(endings)} if endings else {})}
