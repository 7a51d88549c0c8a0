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
from raytruth.comparisons.feasible_sets.kept_feasible_sets import FEASIBLE_SET_ROOMS
from raytruth.comparisons.kills.kill_matrix import KillCell, SceneKills, kills_on
from raytruth.comparisons.kills.set_cover import smallest_cover
from raytruth.comparisons.measures.public_gates import GATES
from raytruth.comparisons.records.kill_results import KILLS_FILE, FaultResult, KillResults, VariantResult
from raytruth.reference_tracer.certified_image import collect_garbage_rarely
from raytruth.reference_tracer.storage.cache import cache_folder
from raytruth.reference_tracer.storage.source_digest import source_digest
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from raytruth.comparisons.faults.fault import Subject
    from raytruth.scenes.scene import Scene

KEPT_FOLDER = "kills"

KILL_ROOMS = (
    *FEASIBLE_SET_ROOMS,
    "comparisons/faults",
    "comparisons/judgement",
    "comparisons/kills",
    "comparisons/matrix/quick_suite.py",  # how large the images are
    "comparisons/measures",
    "comparisons/processes",
    "comparisons/records",
)
"""What kills depend on: the subjects, and how these are rendered, judged, and held to the gates of others."""


def run_kills(scenes: Sequence[Scene], directory: Path, jobs: int, *, fresh: bool) -> Iterator[SceneKills]:
    """Each scene as it is finished; taken from the directory if neither it nor code in KILL_ROOMS has changed."""
    waiting = []
    for scene in scenes:
        kept = None if fresh else _kept(directory, scene)
        if kept is not None:
            yield kept
        else:
            waiting.append(scene)
    if not waiting:
        return
    cache_folder()  # what must be told of it is told once, not by each process
    with ProcessPoolExecutor(min(jobs, len(waiting)), get_context("spawn"), collect_garbage_rarely) as pool:
        # Deep ray trees take longest: first, so that none is left for the end.
        waiting.sort(key=lambda scene: -scene.max_depth)
        running = {pool.submit(_kills_of, scene): scene for scene in waiting}
        try:
            for done in as_completed(running):
                kills = done.result()
                _keep(directory, running[done], kills)
                yield kills
        finally:
            pool.shutdown(cancel_futures=True)


def kill_results(kills: Sequence[SceneKills], seconds: float) -> KillResults:
    """The kill matrix from what all scenes found, in the order of the scenes' names; `seconds` is what it took."""
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
    """Write the kill matrix as `faults.json` into a results directory, whole or not at all. Raises OSError."""
    write_whole(directory / KILLS_FILE, results.model_dump_json(indent=1))


def _kills_of(scene: Scene) -> SceneKills:
    return kills_on(scene, [*all_faults().values(), *all_variants().values()])


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


def _kept_path(directory: Path, scene: Scene) -> Path:
    return directory / KEPT_FOLDER / f"{scene.name}.json"


def kills_key(scene: Scene) -> str:
    """A digest of all that the kills of a scene depend on: the scene, and the code in KILL_ROOMS."""
    return hashlib.sha256(f"{scene.model_dump_json()}\n{source_digest(*KILL_ROOMS)}".encode()).hexdigest()


def _kept(directory: Path, scene: Scene) -> SceneKills | None:
    try:
        kept = json.loads(_kept_path(directory, scene).read_text(encoding="utf-8"))
        if kept["key"] != kills_key(scene):
            return None
        cells = tuple(KillCell(**(cell | {"gates": tuple(cell["gates"])})) for cell in kept["cells"])
        return SceneKills(kept["scene"], cells, kept["seconds"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _keep(directory: Path, scene: Scene, kills: SceneKills) -> None:
    path = _kept_path(directory, scene)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, json.dumps({"key": kills_key(scene), **asdict(kills)}))
