"""Write the kill matrix of a run into docs/kill-matrix.md: `python tools/kill_matrix_in_docs.py results`."""

from __future__ import annotations

import sys
from pathlib import Path

from raytruth.comparisons.records.kill_results import KillResults, read_kill_results
from raytruth.reports.kills import gate_counts, margin, quick_seconds, summary

PAGE = Path(__file__).parent.parent / "docs" / "kill-matrix.md"
BEGIN, END = "<!-- kills: begin -->\n", "<!-- kills: end -->"


def table(results: KillResults) -> str:
    """What comes of the faults, the gates of other suites beside it, and the variants."""
    lines = [summary(results), ""]
    lines += [f"| judged by | kills, of {len(results.faults)} faults | flags, of {len(results.variants)} variants |"]
    lines += [
        "|---|--:|--:|",
        *(f"| {name} | {faults} | {variants} |" for name, faults, variants in gate_counts(results)),
    ]
    seconds = f"{quick_seconds(results):.1f} s of processor time for one renderer"
    lines += ["", f"The quick suite ({seconds}): {', '.join(f'`{name}`' for name in results.quick)}.", ""]
    lines += ["| fault | clause | in a student's words | scenes that kill it | margin |", "|---|---|---|--:|--:|"]
    for fault in results.faults:
        scenes = f"{len(fault.killed_by)} of {len(fault.margins)}"
        name = fault.name.replace("_", " ")
        lines.append(f"| {name} | {fault.clause} | {fault.words} | {scenes} | {margin(fault.margin)} |")
    lines += ["", "| legitimate variant | what it does | margin |", "|---|---|--:|"]
    lines += [f"| {v.name} | {v.words} | {margin(v.largest_margin)} |" for v in results.variants]
    return "\n".join(lines)


def main() -> None:
    """Replace the block between the two marks."""
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, after = rest.split(END)
    text = table(read_kill_results(Path(sys.argv[1])))
    PAGE.write_text(f"{before}{BEGIN}{text}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
