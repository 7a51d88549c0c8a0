"""Loads a declaration from a TOML file. It is untrusted: what it holds is a declaration or a list of mistakes."""

from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from raytruth.comparisons.renderers.program.declaration import Declaration
from raytruth.comparisons.renderers.program.declared_model import contradictions
from raytruth.comparisons.renderers.program.output_images import FORMATS
from raytruth.scenes.validation import problems_of
from raytruth.scenes.wording import place, quoted

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from raytruth.scenes.validation import Location

# A page of text is a few kilobytes.
LARGEST_FILE = 1 << 16
# More than a person reads at once.
_MOST_TOLD = 100
# In place of what is missing or wrong, so that the rest of a declaration can be checked.
_STAND_INS = {"name": "stand-in", "command": ("stand-in", "{scene}", "{output}", "{seed}")}


class DeclarationError(Exception):
    """A declaration cannot be used; `problems` has one sentence for each thing to mend."""

    def __init__(self, problems: Iterable[str]) -> None:
        """Keeps the sentences; the exception's text has one on each line."""
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


def load_declaration(path: Path) -> Declaration:
    """The declaration in a TOML file. Raises DeclarationError, which holds a sentence for every mistake of the file."""
    return checked_declaration(parsed_toml(path), str(path))


def checked_declaration(data: dict[str, Any], source: str) -> Declaration:
    """The declaration that these keys and values state; `source` is where they come from, as a person knows it.

    Raises DeclarationError for all mistakes at once.
    """
    problems: list[tuple[str, str]] = []
    try:
        declaration = Declaration.model_validate(data)
    except ValidationError as error:
        problems += problems_of(error, root=Declaration)
        declaration = Declaration.model_validate(_STAND_INS | _without(data, [it["loc"] for it in error.errors()]))
    problems += [(place(location), told) for location, told in _further_problems(declaration)]
    if problems:
        sentences = [f"{source}: {where}: {told}" for where, told in problems[:_MOST_TOLD]]
        more = [f"{source}: {len(problems) - _MOST_TOLD} more mistakes like these were found."]
        raise DeclarationError(sentences + (more if len(problems) > _MOST_TOLD else []))
    return declaration


def _further_problems(declaration: Declaration) -> Iterator[tuple[Location, str]]:
    """What is wrong with keys that are valid each by itself."""
    for name in ("scene", "output"):
        if not declaration.uses(name):
            yield ("command",), f"expected the placeholder {{{name}}} in one of the words; add it."
    numbers = FORMATS[declaration.writes][1]
    if declaration.numbers is not None and declaration.numbers not in numbers:
        known = " or ".join(map(quoted, numbers))
        yield ("numbers",), f"expected {known} in {declaration.writes}, found {quoted(declaration.numbers)}."
    if declaration.clipped is False and declaration.writes in {"ppm", "png"}:
        yield ("clipped",), "expected true, since whole numbers hold nothing above 1."
    if declaration.colours == "srgb" and declaration.writes == "hdr":
        yield ("colours",), "expected 'linear' in hdr, found 'srgb'."
    yield from contradictions(declaration)


def _without(data: dict[str, Any], wrong: Iterable[tuple[int | str, ...]]) -> dict[str, Any]:
    """The same without what is wrong: keys of the file, or of one of its tables that has keys of its own."""
    kept = {key: dict(value) if isinstance(value, dict) else value for key, value in data.items()}
    for location in wrong:
        table = kept.get(str(location[0]))
        if len(location) > 1 and isinstance(table, dict) and location[0] != "environment":
            table.pop(str(location[1]), None)
        else:
            kept.pop(str(location[0]), None)
    return kept


def parsed_toml(path: Path, start: str = "raytruth renderers --init NAME") -> dict[str, Any]:
    """What a small TOML file of a user holds; `start` is the command that writes one. Raises DeclarationError."""
    try:
        if path.exists() and not path.is_file():
            raise DeclarationError([f"{path}: expected a TOML file, found a folder or a device."])
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except FileNotFoundError as error:
        told = f"{path}: expected a TOML file, found no file of this name; {start} writes one."
        raise DeclarationError([told]) from error
    except (OSError, ValueError) as error:  # ValueError: a NUL character in the name
        raise DeclarationError([f"{quoted(str(path))}: expected a readable TOML file, but {error}."]) from error
    if len(content) > LARGEST_FILE:
        raise DeclarationError([f"{path}: expected at most {LARGEST_FILE} bytes, found more."])
    try:
        return tomllib.loads(content.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise DeclarationError([f"{path}: expected text in UTF-8, found byte {error.start} that is not."]) from error
    except RecursionError as error:
        raise DeclarationError([f"{path}: expected a declaration, found brackets nested too deeply."]) from error
    except ValueError as error:  # TOML that is none, or a whole number of thousands of digits
        raise DeclarationError([f"{path}: expected valid TOML, found a mistake: {error}."]) from error
