"""Measure the diagnosis: `python -m benchmarks.mistakes [--again NAME…]`. Stopped, it goes on where it was."""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TYPE_CHECKING

from benchmarks.mistakes.measurement import key_of, load_results, measured, save
from benchmarks.mistakes.mistakes import all_mistakes, drawn_pairs
from benchmarks.mistakes.page import write_page
from raytruth.comparisons.grading.assignment_file import STARTING, assignment_path, load_assignment
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.processes.interruption import start_worker

if TYPE_CHECKING:
    from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> None:
    """Grade what is not graded yet, keep each result as soon as it is known, and write the page after each."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.mistakes", description="Measure the diagnosis.")
    parser.add_argument("--again", nargs="*", metavar="NAME", help="forget these results first; all without a name")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="scenes side by side (default %(default)s)")
    options = parser.parse_args(arguments)
    mistakes = all_mistakes()
    pairs = drawn_pairs(mistakes)
    results = load_results()
    if options.again is not None:
        for name in options.again or list(results.told):
            del results.told[name]
    path = assignment_path(STARTING)
    assignment = load_assignment(path)
    topics = scenes_of(assignment, path.parent)
    with ProcessPoolExecutor(options.jobs, get_context("spawn"), start_worker) as pool:
        for submission in [*((mistake,) for mistake in mistakes), *pairs]:
            if (key := key_of(submission)) not in results.told:
                told = results.told[key] = measured(submission, assignment, topics, pool)
                save(results)
                print(f"{key}: {', '.join(told.names[:4])} ({told.seconds} s)", file=sys.stderr)
            write_page(results, mistakes, pairs)


if __name__ == "__main__":
    main()
