"""The mutants' results as a page of the documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.rooms import ROOT

if TYPE_CHECKING:
    from tests.mutation.results import FileResults, Reasons, Results

PAGE = ROOT / "docs" / "mutants.md"
BEGIN, END = "<!-- mutants: begin -->\n", "<!-- mutants: end -->"


def write_page(results: Results, reasons: Reasons) -> None:
    """Replace the block between the two marks."""
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, after = rest.split(END)
    PAGE.write_text(f"{before}{BEGIN}{block(results, reasons)}\n{END}{after}", encoding="utf-8")


def block(results: Results, reasons: Reasons) -> str:
    """The counts of each file, then every survivor."""
    files = results.files
    lines = ["| file | mutants | killed by the tests | killed by the matrix alone |", "|---|--:|--:|--:|"]
    lines += [_counts(f"`{file}.py`", [kept]) for file, kept in files.items()]
    lines += [_counts("**all**", list(files.values())), "", "## What the tests leave alive", ""]
    lines += ["| file | function: line → mutated line | by the matrix | why it is no fault |", "|---|---|---|---|"]
    for file, kept in files.items():
        for one in kept.survivors_of_tests:
            reason = reasons.files.get(file, {}).get(one.key, "**not accounted for**")
            lines.append(f"| `{file}.py` | {_code(one.key)} | {one.matrix} | {reason} |")
    lines += ["", "## What the matrix alone leaves alive, and the tests kill", ""]
    lines += ["| file | function: line → mutated line | by the matrix |", "|---|---|---|"]
    for file, kept in files.items():
        lines += [
            f"| `{file}.py` | {_code(one.key)} | {one.matrix} |" for one in kept.survivors if one.tests != "survived"
        ]
    return "\n".join(lines)


def _counts(name: str, of_files: list[FileResults]) -> str:
    mutants = sum(kept.mutants for kept in of_files)
    tests = sum(kept.killed_by_tests for kept in of_files)
    matrix = sum(kept.killed_by_matrix for kept in of_files)
    return f"| {name} | {mutants} | {_share(tests, mutants)} | {_share(matrix, mutants)} |"


def _share(part: int, total: int) -> str:
    return f"{part} ({100 * part / max(1, total):.1f} %)"


def _code(line: str) -> str:
    return "`" + line.replace("|", "\\|") + "`"
