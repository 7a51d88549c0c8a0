"""Judge the mutants of the tracer's physics: `python -m tests.mutation [FILE…]`, or `make mutants`.

Files that have not changed since they were judged are left out. Of those that are named all the same, what the tests
had left alive without a reason is judged by them again: added tests can only kill more. The results go to results.json
and docs/mutants.md. Exit status 1 where a survivor of the tests has no reason, 2 where tests fail without a mutant.
"""

from __future__ import annotations

import multiprocessing
import os
import shutil
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mutation import by_tests
from tests.mutation.mutants import PHYSICS, Mutant, digest_of, mutants_of
from tests.mutation.page import write_page
from tests.mutation.results import (
    FileResults,
    Survivor,
    judged,
    read_reasons,
    read_results,
    unaccounted,
    write_results,
)

JOBS = os.cpu_count() or 1


def main() -> int:
    """Judge, write down, tell."""
    files = sys.argv[1:] or [file for file in PHYSICS if has_changed(file)]
    if unknown := set(files) - set(PHYSICS):
        print(f"There are no mutants of {min(unknown)}: name some of {', '.join(PHYSICS)}.", file=sys.stderr)
        return 2
    with TemporaryDirectory(prefix="raytruth-mutants-") as name:
        if files and not judge_files(files, Path(name)):
            return 2
    results, reasons = read_results(), read_reasons()
    write_page(results, reasons)
    complaints = unaccounted(results, reasons)
    print("\n".join(complaints or ["Every survivor of the tests is accounted for."]))
    return 1 if complaints else 0


def has_changed(file: str) -> bool:
    """Whether the file is another one than when its mutants were judged."""
    kept = read_results().files
    return file not in kept or kept[file].digest != digest_of(file)


def judge_files(files: list[str], folder: Path) -> bool:
    """By the tests in as many processes as there are cores, then by the matrix; False if the tests fail as it is."""
    by_tests.load_libraries()
    copies = [folder / f"copy-{number}" for number in range(JOBS)]
    by_tests.copy_project(copies[0])
    print("All tests of the physics, without a mutant …", flush=True)
    if not by_tests.run_without_mutant(copies[0], by_tests.test_files()):
        print((copies[0] / by_tests.LOG_FILE).read_text(encoding="utf-8"), file=sys.stderr)
        return False
    for copy in copies[1:]:
        shutil.copytree(copies[0], copy)
    # Forks, so that they have the libraries already.
    context = multiprocessing.get_context("fork")
    free = context.SimpleQueue()
    for copy in copies:
        free.put(copy)
    with ProcessPoolExecutor(JOBS, context, _take_copy, (free,)) as pool:
        for file in files:
            start = time.monotonic()
            if has_changed(file):
                mutants = mutants_of(file)
                outcomes = list(pool.map(_by_tests, mutants))
                survivors = judged(mutants, outcomes, _by_matrix(mutants, folder))
            else:
                mutants = [mutant for mutant in mutants_of(file) if is_open(mutant)]
                survivors = judged_again(file, dict(zip(mutants, pool.map(_by_tests, mutants), strict=True)))
            counts = FileResults(digest=digest_of(file), mutants=len(mutants_of(file)), survivors=survivors)
            write_results(read_results().with_file(file, counts))
            told = f"{counts.killed_by_tests} killed by the tests, {counts.killed_by_matrix} by the matrix"
            print(f"{file}.py: of {counts.mutants} mutants {told}; {time.monotonic() - start:.0f} s", flush=True)
    return True


def is_open(mutant: Mutant) -> bool:
    """Whether the tests left it alive when they last judged it, and nobody has said why that is right."""
    survivors = {one.key for one in read_results().files[mutant.file].survivors_of_tests}
    return mutant.key in survivors - read_reasons().files.get(mutant.file, {}).keys()


def judged_again(file: str, outcomes: dict[Mutant, str]) -> list[Survivor]:
    """The file's survivors, with what the tests say now of those that they had left alive; one may share its line."""
    left = {mutant.key for mutant, outcome in outcomes.items() if outcome == "survived"}
    killed = {mutant.key for mutant in outcomes} - left
    kept = read_results().files[file].survivors
    now = [one.model_copy(update={"tests": "killed"}) if one.key in killed else one for one in kept]
    return [one for one in now if one.tests == "survived" or one.survives_matrix]


_copy = Path()


def _take_copy(free: multiprocessing.queues.SimpleQueue[Path]) -> None:
    """Each process of the pool has a copy of the project for itself."""
    global _copy  # noqa: PLW0603 - a pool's initializer can leave something for its tasks in no other way
    _copy = free.get()


def _by_tests(mutant: Mutant) -> str:
    return by_tests.judge(mutant, _copy, by_tests.test_files())


def _by_matrix(mutants: list[Mutant], folder: Path) -> list[str]:
    """In processes of their own, which may load the tracer; each mutant's outcome."""
    from tests.mutation import by_matrix  # noqa: PLC0415 - loads the tracer, which the other judge must not

    chunks = [mutants[first::JOBS] for first in range(JOBS)]
    folders = [folder / f"matrix-{number}" for number in range(JOBS)]
    outcomes: list[str] = [""] * len(mutants)
    with ProcessPoolExecutor(JOBS, multiprocessing.get_context("spawn")) as pool:
        done = pool.map(by_matrix.judge_all, chunks, folders, [by_matrix.all_scenes()] * JOBS)
        for first, chunk in enumerate(done):
            outcomes[first::JOBS] = chunk
    return outcomes


if __name__ == "__main__":
    sys.exit(main())
