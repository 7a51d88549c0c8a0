"""The mistakes that can be switched on in the example tracers: texts of their sources, and what stands there instead.

They are kept as data, a file for each language, and were written from the physics and the languages, without the edits
of the catalogue of faults.
"""

from __future__ import annotations

import random
import shutil
import subprocess
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

FOLDER = Path(__file__).parent
TRACERS = FOLDER.parent.parent / "examples" / "tracers"
LANGUAGES = ("cpp", "python", "rust", "go", "java", "javascript")
# The pairs are drawn, so that nobody has chosen those which are easy to tell; any other seed would do.
SEED = 17
PAIRS = 30


class Part(BaseModel):
    """Unknown keys and wrong kinds are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Mistake(Part):
    """A text of an example's source, and what stands there with the mistake."""

    name: str
    language: str
    file: str
    topic: str | None = None
    """The first topic of the assignment, in its order, that must lose points; none for a global mistake, which is
    charged apart."""
    known_as: frozenset[str] = frozenset()
    """The catalogue's faults, or the global mistakes, that it is; none where there is no such fault."""
    old: str
    new: str


def all_mistakes() -> list[Mistake]:
    """Of all languages, in the order of the files."""
    return [mistake for language in LANGUAGES for mistake in _mistakes_of(language)]


def drawn_pairs(mistakes: list[Mistake]) -> list[tuple[Mistake, Mistake]]:
    """Two at once, that are known and can be switched on together, in the tracer that runs in the least time."""
    known = [mistake for mistake in mistakes if mistake.known_as and mistake.language == "cpp"]
    every = [(one, other) for place, one in enumerate(known) for other in known[place + 1 :]]
    together = [pair for pair in every if pair[0].known_as.isdisjoint(pair[1].known_as) and _go_together(pair)]
    return random.Random(SEED).sample(together, PAIRS)


def write_submission(mistakes: tuple[Mistake, ...], folder: Path) -> Path:
    """Copy the example with these mistakes, all of one language, into a folder, build it, and return its declaration.

    Raises ValueError where the example does not hold what a mistake alters exactly once, and
    subprocess.CalledProcessError where it cannot be built.
    """
    (language,) = {mistake.language for mistake in mistakes}
    example = TRACERS / _stated(language)["folder"]
    for path in example.iterdir():
        if path.is_file():
            shutil.copy(path, folder / path.name)
    for name, text in _altered(mistakes).items():
        (folder / name).write_text(text, encoding="utf-8")
    if build := _stated(language)["build"]:
        subprocess.run(build, cwd=folder, check=True, capture_output=True, timeout=120)
    return folder / "tracer.toml"


def _altered(mistakes: tuple[Mistake, ...]) -> dict[str, str]:
    """The texts of the files that the mistakes alter. Raises ValueError where one does not find its place."""
    texts: dict[str, str] = {}
    for mistake in mistakes:
        text = texts.get(mistake.file) or _source(mistake.language, mistake.file)
        if text.count(mistake.old) != 1:
            raise ValueError(f"{mistake.name}: found {mistake.old!r} {text.count(mistake.old)} times")
        texts[mistake.file] = text.replace(mistake.old, mistake.new)
    return texts


@cache
def _source(language: str, file: str) -> str:
    return (TRACERS / _stated(language)["folder"] / file).read_text(encoding="utf-8")


def _go_together(pair: tuple[Mistake, Mistake]) -> bool:
    """Whether both find their places, whichever is switched on first, and neither undoes the other."""
    try:
        return _altered(pair) == _altered(pair[::-1])
    except ValueError:
        return False


def _mistakes_of(language: str) -> list[Mistake]:
    stated = _stated(language)
    defaults = {"language": language, "file": stated["file"]}
    return [
        Mistake.model_validate(defaults | each | {"known_as": frozenset(each.get("known_as", ()))})
        for each in stated["mistakes"]
    ]


@cache
def _stated(language: str) -> dict[str, Any]:
    return tomllib.loads((FOLDER / f"{language}.toml").read_text(encoding="utf-8"))
