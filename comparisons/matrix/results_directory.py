"""The results directory: assembling a run's results, with those of earlier partial runs."""

from __future__ import annotations

import datetime
import errno
import fcntl
import os
import platform
import shutil
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from importlib.metadata import version
from typing import TYPE_CHECKING, TypeVar

from raytruth.comparisons.matrix.cell import UNFINISHED_CELL
from raytruth.comparisons.matrix.earlier_results import earlier_results, renderer_record, scene_record
from raytruth.comparisons.matrix.whole_cells import CELL_FILE
from raytruth.comparisons.measures.metrics import compute_metrics_batch
from raytruth.comparisons.records.image_files import ImageError, read_image
from raytruth.comparisons.records.results import (
    RESULTS_FILE,
    Cell,
    RendererRecord,
    Results,
    SceneRecord,
)
from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene


UNFINISHED = (f"cells/*/{UNFINISHED_CELL}*", f".{RESULTS_FILE}.*", ".report-*")
"""What is renamed when it is whole: folders of cells, results.json, the report."""

Named = TypeVar("Named", SceneRecord, RendererRecord)


@contextmanager
def only_run_in(directory: Path) -> Iterator[None]:
    """Make the directory and keep other runs from writing there; what a killed one left unfinished is removed.

    Raises OSError where another run is writing.
    """
    directory.mkdir(parents=True, exist_ok=True)
    handle = os.open(directory, os.O_RDONLY)
    try:
        _lock(handle, directory)
        for pattern in UNFINISHED:
            for path in directory.glob(pattern):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        yield
    finally:
        os.close(handle)


def _lock(handle: int, directory: Path) -> None:
    """The lock ends with this process, however that ends."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        told = "another run is writing there; wait for it, or give another --out"
        raise OSError(errno.EBUSY, told, str(directory)) from error


def write_results(
    directory: Path,
    command: str,
    scenes: Sequence[Scene],
    renderers: Sequence[tuple[Renderer, str | None]],
    cells: Sequence[Cell],
) -> Results:
    """Write results.json: these cells, and those of earlier runs into this directory that these do not replace.

    Beside each renderer stands its version, None where it cannot run here.
    Where that changes nothing, the file stays as it is, with the date of the results that it holds.
    """
    earlier = earlier_results(directory)
    place = {cell_place(cell): number for number, cell in enumerate(cells)}
    kept = [cell for cell in earlier.cells if cell_place(cell) not in place] if earlier else []
    results = Results(
        raytruth_version=version("raytruth"),
        created=datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
        command=command,
        machine=_machine(),
        scenes=_by_name((*(earlier.scenes if earlier else ()), *(scene_record(scene) for scene in scenes))),
        renderers=_by_name((*(earlier.renderers if earlier else ()), *(renderer_record(*pair) for pair in renderers))),
        cells=tuple(sorted((*kept, *cells), key=cell_place)),
    )
    if earlier is not None and results.model_copy(update={"created": earlier.created}) == earlier:
        return earlier
    write_whole(directory / RESULTS_FILE, results.model_dump_json(indent=1))
    return results


def cell_place(cell: Cell) -> tuple[str, str, str]:
    """What tells a cell from all others of a results directory: scene, renderer and integrator."""
    return cell.scene, cell.renderer, cell.integrator


def with_metrics(directory: Path, cells: Sequence[Cell]) -> list[Cell]:
    """The cells with their global metrics, computed in two batches side by side where they are missing."""
    lacking = [cell for cell in cells if cell.images is not None and cell.metrics is None]
    with ThreadPoolExecutor(2) as pool:  # each batch waits for a process of its own
        measured = list(pool.map(lambda part: _measured(directory, part), (lacking[::2], lacking[1::2])))
    by_place = {cell_place(cell): cell for part in measured for cell in part}
    return [by_place.get(cell_place(cell), cell) for cell in cells]


def _measured(directory: Path, cells: Iterable[Cell]) -> list[Cell]:
    readable: list[Cell] = []
    pairs = []
    for cell in cells:
        assert cell.images is not None, "only cells with images are measured"
        try:
            pair = (read_image(directory / cell.images.render), read_image(directory / cell.images.truth))
        except ImageError:
            continue  # the report says that the image is missing
        readable.append(cell)
        pairs.append(pair)
    measured = []
    for cell, metrics in zip(readable, compute_metrics_batch(pairs), strict=True):
        complete = cell.model_copy(update={"metrics": metrics})
        write_whole(directory / cell.folder / CELL_FILE, complete.model_dump_json(indent=1))
        measured.append(complete)
    return measured


def _by_name(records: Iterable[Named]) -> tuple[Named, ...]:
    """The last record of each name."""
    return tuple({record.name: record for record in records}.values())


def _machine() -> dict[str, str]:
    return {
        "system": platform.platform(),
        "python": platform.python_version(),
        "processors": str(os.cpu_count()),
    }
