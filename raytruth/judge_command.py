"""`raytruth judge`: the verdict on finished pictures."""

from __future__ import annotations

import shlex
import sys
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.comparisons.matrix.cell import CellPlace
from raytruth.comparisons.matrix.plan import PlannedCell
from raytruth.comparisons.matrix.results_directory import only_run_in, with_metrics, write_results
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.records.image_files import ImageError
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.program.declaration_file import DeclarationError, load_declaration
from raytruth.comparisons.renderers.program.finished_image import FinishedImage, column_names, declared_by_itself
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder, open_scene
from raytruth.output import print_json, progress, say
from raytruth.programs import FILE_OPTION
from raytruth.reports.wording import printable
from raytruth.written_report import written_report

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from raytruth.comparisons.records.results import Cell
    from raytruth.comparisons.renderers.program.declaration import Declaration
    from raytruth.scenes.scene import Scene

FAILED = 1


def judge(
    *images: Path,
    scene: str,
    renderer_file: Path | None = None,
    bits: int | None = None,
    srgb: Annotated[bool, Parameter(negative="")] = False,
    out: Path | None = None,
    as_json: AsJson = False,
) -> int:
    """Judge finished pictures of a scene, whoever rendered them.

    Parameters
    ----------
    images
        OpenEXR, PFM, Radiance HDR, PPM or PNG files of the scene's size, by their endings.
    scene
        A scene of the library, or the path of a .json file.
    renderer_file
        What rendered them, as this TOML file declares it (`raytruth renderers --init NAME` writes one).
    bits
        Without such a file: how many bits its arithmetic has, less those for other formulas; 39 by default.
    srgb
        Without such a file: the pictures are encoded by the curve of sRGB.
    out
        Also write results and a report to this folder.
    as_json
        Print one JSON document instead of text: the cell or, of several pictures, a list of them.
    """
    if not images:
        raise UsageError("judge: expected a picture at least, found none.")
    if out is not None:
        expect_folder(out)
    opened = open_scene(scene)
    finished = _finished(images, renderer_file, bits, srgb=srgb)
    with _folder(out) as directory, only_run_in(directory):
        with progress("Judging"):
            cells = [_judged(image, opened, scene, directory) for image in finished]
        report = None if out is None else _written(out, opened, finished, cells)
    if report is None:  # there will be no files
        cells = [cell.model_copy(update={"images": None, "log": None}) for cell in cells]
    _show(images, cells, report, as_json=as_json)
    return FAILED if any(cell.verdict in {Verdict.FAIL, Verdict.ERROR} for cell in cells) else 0


def _finished(images: Sequence[Path], file: Path | None, bits: int | None, *, srgb: bool) -> list[FinishedImage]:
    """The pictures with what is declared of them. Raises UsageError with every mistake."""
    if file is not None and (bits is not None or srgb):
        raise UsageError(f"{FILE_OPTION}: expected neither --bits nor --srgb beside it; the file says both.")
    if bits is not None and not 8 <= bits <= 53:
        raise UsageError(f"--bits: expected a number from 8 to 53, found {bits}.")
    options = [f"{FILE_OPTION} {shlex.quote(str(file))}"] if file is not None else []
    options += [f"--bits {bits}"] if bits is not None else []
    options += ["--srgb"] if srgb else []
    problems: list[str] = []
    finished = []
    shared = None if file is None else _declared(file)
    for name, path in zip(column_names(tuple(images)), images, strict=True):
        try:
            if not path.is_file():
                raise ImageError("expected a picture, found no file of this name")
            declaration = shared or declared_by_itself(path, bits, is_srgb=srgb)
        except ImageError as error:
            problems.append(f"{path}: {error}.")
            continue
        finished.append(FinishedImage(name, path, declaration, " ".join(options)))
    if problems:
        raise UsageError("\n".join(problems))
    return finished


def _declared(file: Path) -> Declaration:
    try:
        declaration = load_declaration(file)
    except DeclarationError as error:
        raise UsageError(str(error)) from error
    if declaration.sampling.samples:
        raise UsageError(f"{file}: sampling: one picture of random samples cannot be judged; use raytruth run.")
    return declaration


@contextmanager
def _folder(out: Path | None) -> Iterator[Path]:
    """Where the cells are written; without --out nothing is left of them."""
    if out is not None:
        yield out
        return
    with TemporaryDirectory(prefix="raytruth-") as name:
        yield Path(name)


def _judged(image: FinishedImage, scene: Scene, source: str, directory: Path) -> Cell:
    """The cell of a picture, as the matrix makes it."""
    ((_, error_model),) = image.error_models
    (integrator,) = image.integrators
    place = CellPlace(scene, image, integrator, key="", source=source, version=image.version())
    make_truth(scene, directory)
    (cell,) = run_cells([PlannedCell(place, scene.max_depth, error_model.in_scene(scene))], directory)
    return cell


def _written(out: Path, scene: Scene, finished: Sequence[FinishedImage], cells: Sequence[Cell]) -> Path:
    """The report in the folder, after results and measures."""
    with progress("Measuring global differences"):
        cells = with_metrics(out, cells)
    command = printable(shlex.join(["raytruth", *sys.argv[1:]]))
    write_results(out, command, [scene], [(image, image.version()) for image in finished], cells)
    return written_report(out)


def _show(images: Sequence[Path], cells: Sequence[Cell], report: Path | None, *, as_json: bool) -> None:
    if as_json:
        records = [cell.model_dump(mode="json") for cell in cells]
        print_json(records[0] if len(records) == 1 else {"cells": records})
        return
    for path, cell in zip(images, cells, strict=True):
        say(f"{cell.verdict:12} {path}: {cell.reason}")
        worst = cell.judgement.worst if cell.judgement is not None else None
        if cell.verdict == Verdict.FAIL and worst is not None:
            place = f"column {worst.x}, row {worst.y}"
            value, truth = (", ".join(f"{number:.6g}" for number in color) for color in (worst.value, worst.truth))
            say(f"{'':12} worst at {place}: ({value}) where ({truth}) is due")
    if report is not None:
        say(f"Report: {report}")
