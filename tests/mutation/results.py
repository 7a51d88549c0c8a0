"""What came of the mutants, as a file that is kept: how many there are, and every survivor of either judge."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import BaseModel

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tests.mutation.mutants import Mutant

MUTANTS_FILE = Path(__file__).with_name("results.json")
REASONS_FILE = Path(__file__).with_name("equivalent.json")


class Survivor(BaseModel):
    """A mutant that at least one judge did not kill."""

    key: str
    tests: str
    """`killed`, `killed by time` or `survived`."""
    matrix: str
    """The scene that kills it, `survived`, or `not planted`."""

    @property
    def survives_matrix(self) -> bool:
        """Whether no scene kills it."""
        return self.matrix in {"survived", "not planted"}


class FileResults(BaseModel):
    """All mutants of one file."""

    digest: str
    """Of the file when they were judged."""
    mutants: int
    survivors: list[Survivor]

    @property
    def killed_by_tests(self) -> int:
        """How many."""
        return self.mutants - len(self.survivors_of_tests)

    @property
    def killed_by_matrix(self) -> int:
        """How many."""
        return self.mutants - sum(one.survives_matrix for one in self.survivors)

    @property
    def survivors_of_tests(self) -> list[Survivor]:
        """Those that need a reason."""
        return [one for one in self.survivors if one.tests == "survived"]


class Results(BaseModel):
    """All files, by name."""

    files: dict[str, FileResults]

    def with_file(self, file: str, of_file: FileResults) -> Results:
        """These results, with others for one file."""
        return Results(files=self.files | {file: of_file})


class Reasons(BaseModel):
    """Why survivors of the tests are no faults: by file, then by the mutant's key."""

    files: dict[str, dict[str, str]]


def judged(mutants: Iterable[Mutant], by_tests: Iterable[str], by_matrix: Iterable[str]) -> list[Survivor]:
    """The survivors among mutants with these outcomes."""
    outcomes = zip(mutants, by_tests, by_matrix, strict=True)
    all_of_them = [Survivor(key=mutant.key, tests=tests, matrix=matrix) for mutant, tests, matrix in outcomes]
    return [one for one in all_of_them if one.tests == "survived" or one.survives_matrix]


def read_results() -> Results:
    """What was kept; nothing if there is none."""
    return Results.model_validate_json(MUTANTS_FILE.read_bytes()) if MUTANTS_FILE.exists() else Results(files={})


def write_results(results: Results) -> None:
    """Keep it."""
    MUTANTS_FILE.write_text(results.model_dump_json(indent=1) + "\n", encoding="utf-8")


def read_reasons() -> Reasons:
    """The reasons that people gave."""
    return Reasons.model_validate_json(REASONS_FILE.read_bytes())


def unaccounted(results: Results, reasons: Reasons) -> list[str]:
    """Survivors of the tests without a reason, and reasons without a survivor; each in a few words."""
    survivors = {(file, one.key) for file, kept in results.files.items() for one in kept.survivors_of_tests}
    explained = {(file, key) for file, of_file in reasons.files.items() for key in of_file}
    return [
        *(f"{file}.py, {key}: survived the tests without a reason" for file, key in sorted(survivors - explained)),
        *(f"{file}.py, {key}: has a reason, and did not survive" for file, key in sorted(explained - survivors)),
    ]
