"""Write the numbers of a run into README.md: `python tools/matrix_in_readme.py results`."""

from __future__ import annotations

import sys
from pathlib import Path

from raytruth.comparisons.records.results import RESULTS_FILE, Results, Verdict

README = Path(__file__).parent.parent / "README.md"
BEGIN, END = "matrix: begin -->\n", "<!-- matrix: end -->"


def table(results: Results) -> str:
    """How many scenes pass on each renderer and integrator, and the largest error of a scene without random numbers."""
    heads = ("renderer", "integrator", "pass", "declared", "fail or error", "incomparable", "largest error, median")
    lines = [f"| {' | '.join(heads)} |", "|---|---|--:|--:|--:|--:|--:|"]
    for renderer, integrator in sorted({(cell.renderer, cell.integrator) for cell in results.cells}):
        cells = [cell for cell in results.cells if (cell.renderer, cell.integrator) == (renderer, integrator)]
        counts = [
            sum(cell.verdict in group for cell in cells)
            for group in ({Verdict.PASS}, {Verdict.DECLARED}, {Verdict.FAIL, Verdict.ERROR}, {Verdict.INCOMPARABLE})
        ]
        errors = sorted(c.largest_error for c in cells if c.largest_error is not None and c.stochastic is None)
        median = f"{errors[len(errors) // 2]:.1e}" if errors else ""
        lines.append(f"| `{renderer}` | {integrator} | {' | '.join(map(str, counts))} | {median} |")
    return "\n".join(lines)


def main() -> None:
    """Replace the block between the two marks."""
    results = Results.model_validate_json((Path(sys.argv[1]) / RESULTS_FILE).read_text(encoding="utf-8"))
    before, rest = README.read_text(encoding="utf-8").split(BEGIN)
    _, after = rest.split(END)
    date = results.created.partition("T")[0]
    text = f"The library's {len(results.scenes)} scenes, as of {date} (scenes without random numbers for the error):"
    README.write_text(f"{before}{BEGIN}{text}\n\n{table(results)}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
