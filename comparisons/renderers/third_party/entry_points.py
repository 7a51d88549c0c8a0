"""Finds the adapters that installed packages offer under Python's entry points (docs/adapters.md)."""

from __future__ import annotations

import functools
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers.third_party.adapter import ThirdPartyRenderer

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "raytruth.renderers"
"""The group of entry points; each names a function without arguments that returns an object obeying Renderer."""

# Loading an adapter renders nothing; a renderer's library may take a second or some to be imported.
TRIAL_SECONDS = 30.0
# Of address space: libraries of renderers with their threads reserve several gigabytes.
TRIAL_BYTES = 16 << 30


@dataclass(frozen=True)
class ThirdParty:
    """What other packages offer."""

    renderers: dict[str, ThirdPartyRenderer]
    """Those that can be used, each by its name."""
    problems: tuple[str, ...]
    """A sentence for each that is left out."""


@functools.cache
def third_party(taken: frozenset[str]) -> ThirdParty:
    """The adapters that are installed, but for those whose names are taken; each is tried in a process of its own."""
    renderers: dict[str, ThirdPartyRenderer] = {}
    problems: list[str] = []
    found = {(_origin(point), point.name, point.value): point for point in entry_points(group=GROUP)}
    with ThreadPoolExecutor() as pool:
        trials = dict(zip(found, pool.map(_trial, found.values()), strict=True))
    for place, point in sorted(found.items()):
        origin, name, _ = place
        wrong = trials[place]
        if wrong is None:
            renderer = ThirdPartyRenderer(point.load()(), origin)
            wrong = _taken(renderer.name, taken, renderers)
        if wrong is None:
            renderers[renderer.name] = renderer
        else:
            problems.append(f"The renderer {name!a} of the package {origin} is left out: {wrong}.")
    return ThirdParty(renderers, tuple(problems))


def _origin(point: EntryPoint) -> str:
    """The package that an entry point comes with, and its version."""
    return f"{point.dist.name} {point.dist.version}" if point.dist is not None else "unknown"


def _trial(point: EntryPoint) -> str | None:
    """Why it cannot be used, in a clause; None if it can."""
    command = [sys.executable, "-m", "raytruth.comparisons.renderers.third_party.trial", point.value]
    with TemporaryDirectory(prefix="raytruth-") as folder:
        try:
            run_isolated(command, Path(folder), seconds=TRIAL_SECONDS, memory_bytes=TRIAL_BYTES)
        except RendererError as error:
            return f"its trial failed ({error})"
    return None


def _taken(name: str, taken: frozenset[str], others: dict[str, ThirdPartyRenderer]) -> str | None:
    """Who has the name already, in a clause; None if nobody has."""
    if name in taken:
        return f"the name {name} is that of one of raytruth's own renderers"
    if name in others:
        return f"the name {name} is that of a renderer of the package {others[name].origin}"
    return None
