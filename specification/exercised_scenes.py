"""Which scenes exercise a clause: those that kill its faults, or may do so."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

from raytruth.comparisons.records.kill_results import KILLS_FILE, read_kill_results
from raytruth.reference_tracer.arithmetics.instantiation import functions_of
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from pathlib import Path


def scenes_by_fault(directory: Path) -> dict[str, tuple[str, ...]]:
    """The scenes that killed each fault when `raytruth faults` last wrote to this results directory; {} if never.

    Raises ValueError for a results file that is damaged.
    """
    if not (directory / KILLS_FILE).is_file():
        return {}
    return {fault.name: fault.killed_by for fault in read_kill_results(directory).faults}


def scenes_by_function() -> dict[str | None, tuple[str, ...]]:
    """The names of all scenes whose kernel holds a function, by its name; under None all scenes."""
    found: dict[str | None, list[str]] = defaultdict(list)
    for name in library_names():
        found[None].append(name)
        for function in functions_of(frozenset(required_features(open_scene(name)))):
            found[function].append(name)
    return {function: tuple(names) for function, names in found.items()}
