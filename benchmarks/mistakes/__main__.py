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
from raytruth.comparisons.processes.interruption import start_worker

if TYPE_CHECKING:
    from collections.abc import Sequence


def main(arguments: Sequence[str] | None = None) -> None:
    """Grade what is not graded yet, keep each result as soon as it is known, and write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.mistakes", description="Measure the diagnosis.")
    parser.add_argument("--again", nargs="*", default=[], metavar="NAME", help="forget these results first")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="scenes side by side (default %(default)s)")
    options = parser.parse_args(arguments)
    mistakes = all_mistakes()
    pairs = drawn_pairs(mistakes)
    submissions = [*((mistake,) for mistake in mistakes), *pairs]
    results = load_results()
    for name in options.again:
        results.told.pop(name, None)
    with ProcessPoolExecutor(options.jobs, get_context("spawn"), start_worker) as pool:
        for submission in submissions:
            if key_of(submission) in results.told:
                continue
            told = measured(submission, pool)
            results.told[key_of(submission)] = told
            save(results)
            print(key_of(submission), told.names[:4], told.lost, told.is_unknown, told.seconds, file=sys.stderr)
    write_page(results, mistakes, pairs)


if __name__ == "__main__":
    main()
