"""Runs the kill matrix in processes, scene by scene, and keeps what is done beside the results."""

from __future__ import annotations

import hashlib
import json
import math
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict
from multiprocessing import get_context
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.variants import all_variants
from raytruth.comparisons.kills.kill_matrix import KillCell, SceneKills, kills_on
from raytruth.comparisons.kills.set_cover import smallest_cover
from raytruth.comparisons.measures.public_gates import GATES
from raytruth.comparisons.records.kill_results import RESULTS_FILE, FaultResult, KillResults, VariantResult
from raytruth.reference_tracer.certified_image import collect_garbage_rarely
from raytruth.reference_tracer.storage.source_digest import source_digest
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from raytruth.comparisons.faults.fault import Subject

KEPT_FOLDER = "kills"


def run_kills(sources: Sequence[str], directory: Path, jobs: int, *, fresh: bool) -> Iterator[SceneKills]:
    """Each scene as it is finished; taken from the directory where neither it nor any of our code has changed."""
    waiting = []
    for source in sources:
        kept = None if fresh else _kept(directory, source)
        if kept is not None:
            yield kept
        else:
            waiting.append(source)
    if not waiting:
        return
    with ProcessPoolExecutor(min(jobs, len(waiting)), get_context("spawn"), collect_garbage_rarely) as pool:
        # Deep ray trees take longest: first, so that none is left for the end.
        waiting.sort(key=lambda source: -open_scene(source).max_depth)
        running = {pool.submit(_kills_of, source): source for source in waiting}
        try:
            for done in as_completed(running):
                kills = done.result()
                _keep(directory, running[done], kills)
                yield kills
        finally:
            pool.shutdown(cancel_futures=True)


def kill_results(kills: Sequence[SceneKills], seconds: float) -> KillResults:
    """All scenes put together, in the order of their names."""
    ordered = sorted(kills, key=lambda scene: scene.scene)
    faults = tuple(_fault_result(name, ordered) for name in all_faults())
    killers = [set(fault.killed_by) for fault in faults if fault.killed]
    costs = {scene.scene: scene.seconds for scene in ordered}
    return KillResults(
        faults=faults,
        variants=tuple(_variant_result(name, ordered) for name in all_variants()),
        seconds=seconds,
        scenes=costs,
        gates=tuple(GATES),
        quick=smallest_cover(killers, costs),
    )


def write_kill_results(directory: Path, results: KillResults) -> None:
    """Into the directory, whole or not at all."""
    write_whole(directory / RESULTS_FILE, results.model_dump_json(indent=1))


def _kills_of(source: str) -> SceneKills:
    return kills_on(open_scene(source), [*all_faults().values(), *all_variants().values()])


def _fault_result(name: str, kills: Sequence[SceneKills]) -> FaultResult:
    fault = all_faults()[name]
    cells = _cells(name, kills)
    killed_by = tuple(scene for scene, cell in cells.items() if cell.fails)
    largest = max((cell.margin for cell in cells.values()), default=0.0)
    return FaultResult(
        name=name,
        words=fault.words,
        clause=fault.clause,
        hint=fault.hint,
        killed=bool(killed_by),
        killed_by=killed_by,
        margin=_finite(largest),
        margins={scene: _finite(cell.margin) for scene, cell in cells.items()},
        errors={scene: cell.error for scene, cell in cells.items() if cell.error},
        gates=_rejecting(cells),
    )


def _variant_result(name: str, kills: Sequence[SceneKills]) -> VariantResult:
    variant: Subject = all_variants()[name]
    cells = _cells(name, kills)
    return VariantResult(
        name=name,
        words=variant.words,
        flagged=any(cell.fails for cell in cells.values()),
        margins={scene: _finite(cell.margin) for scene, cell in cells.items()},
        errors={scene: cell.error for scene, cell in cells.items() if cell.error},
        gates=_rejecting(cells),
    )


def _cells(name: str, kills: Sequence[SceneKills]) -> dict[str, KillCell]:
    return {scene.scene: cell for scene in kills for cell in scene.cells if cell.subject == name}


def _rejecting(cells: Mapping[str, KillCell]) -> tuple[str, ...]:
    return tuple(gate for gate in GATES if any(gate in cell.gates for cell in cells.values()))


def _finite(margin: float) -> float | None:
    return margin if math.isfinite(margin) else None


def _kept_path(directory: Path, source: str) -> Path:
    return directory / KEPT_FOLDER / f"{open_scene(source).name}.json"


def _key(source: str) -> str:
    parts = (open_scene(source).model_dump_json(), source_digest("scenes", "reference_tracer", "comparisons"))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _kept(directory: Path, source: str) -> SceneKills | None:
    try:
        kept = json.loads(_kept_path(directory, source).read_text(encoding="utf-8"))
        if kept["key"] != _key(source):
            return None
        cells = tuple(KillCell(**(cell | {"gates": tuple(cell["gates"])})) for cell in kept["cells"])
        return SceneKills(kept["scene"], cells, kept["seconds"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _keep(directory: Path, source: str, kills: SceneKills) -> None:
    path = _kept_path(directory, source)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, json.dumps({"key": _key(source), **asdict(kills)}))
