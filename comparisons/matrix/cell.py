"""One cell of the matrix: render, judge, and write the cell whole or not at all."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkdtemp
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.feasible_sets.costly_lines import costliest_line
from raytruth.comparisons.judgement.exact_test import largest_error
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits, verdict_of_first_hits
from raytruth.comparisons.judgement.pixel_verdict import together, with_shortcuts
from raytruth.comparisons.judgement.verdict import judge_exact, judge_light_paths, judge_noisy, of_pixel_areas
from raytruth.comparisons.matrix.whole_cells import CELL_FILE, files_digest
from raytruth.comparisons.noise.pixel_areas import largest_displacement
from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.pixel_evidence import write_pixel_evidence
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.records.results import Cell, Images, Verdict
from raytruth.comparisons.renderers.protocol import command_of, error_model_of
from raytruth.reference_tracer.camera_rays import CENTRES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.judgement.verdict import Expectation, ImageVerdict
    from raytruth.comparisons.records.renderings import Rendering
    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene

TRUTH_FILE = "truth.exr"
AREA_MEANS_FILE = "area-means.exr"
LOG_FILE = "log.txt"
UNFINISHED_CELL = ".unfinished-"
"""What the name of a cell's folder begins with until it is whole."""


@dataclass(frozen=True, eq=False)
class CellPlace:
    """Which cell, and what identifies everything it depends on."""

    scene: Scene
    renderer: Renderer
    integrator: Integrator
    key: str
    source: str
    """What names the scene on the command line: its library name or its path."""
    version: str | None = None
    """The renderer's; asking for it may take a trial render."""

    @property
    def folder(self) -> str:
        """The cell's folder, as a path relative to the results directory."""
        return f"cells/{self.scene.name}/{self.renderer.name}-{self.integrator.name}"

    @property
    def command(self) -> str:
        """The command that repeats the cell."""
        return command_of(self.renderer, self.source)


def run_cell(place: CellPlace, depth: int, expectation: Expectation, directory: Path) -> Cell:
    """Render and judge in a temporary folder, which then takes the cell's place; a failed render is an error cell."""
    target = directory / place.folder
    target.parent.mkdir(parents=True, exist_ok=True)
    folder = Path(mkdtemp(prefix=f"{UNFINISHED_CELL}{target.name}-", dir=target.parent))
    try:
        cell = _judged(place, depth, expectation, folder)
        for scratch in (*folder.glob("*.npz"), *folder.glob("job.json")):
            scratch.unlink()
        (folder / CELL_FILE).write_text(cell.model_dump_json(indent=1), encoding="utf-8")
        folder.chmod(0o755)
        shutil.rmtree(target, ignore_errors=True)
        folder.replace(target)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return cell


def settled_cell(place: CellPlace, verdict: Verdict, reason: str) -> Cell:
    """A cell without an image: one that was not rendered, or was lost while it was; `reason` says why."""
    return Cell(**_names(place), verdict=verdict, reason=reason)


def _judged(place: CellPlace, depth: int, expectation: Expectation, folder: Path) -> Cell:
    displaced = _displaced(place)
    if displaced is not None:
        return Cell(**_circumstances(place, folder), verdict=Verdict.INCOMPARABLE, reason=displaced)
    try:
        rendering = place.renderer.render(place.scene, place.integrator.name, depth, expectation.rays, folder)
        _check_sizes(rendering, place.integrator.gives, expectation.truth)
    except RendererError as error:
        return Cell(**_circumstances(place, folder), verdict=Verdict.ERROR, reason=str(error))
    hits = None if rendering.first_hits is None else judge_first_hits(rendering.first_hits, expectation.feasible)
    told = _circumstances(place, folder) | {"seconds": rendering.seconds, "first_hits": hits}
    if rendering.image is None:
        assert hits is not None, "checked with the sizes"
        verdict, reason = with_shortcuts(*verdict_of_first_hits(hits), expectation.shortcuts)
        return Cell(**told, verdict=verdict, reason=reason)
    truth, expectation = _truth_of(place, expectation, folder)
    judged = _judged_image(rendering, place, expectation)
    verdict, reason = judged.verdict, judged.reason
    if hits is not None:
        verdict, reason = together((verdict, reason), verdict_of_first_hits(hits))
    verdict, reason = with_shortcuts(verdict, reason, expectation.shortcuts)
    if verdict == Verdict.INCOMPARABLE:
        reason = "; ".join(filter(None, [reason, _costliest_line(place, expectation)]))
    return Cell(
        **told,
        verdict=verdict,
        reason=reason,
        largest_error=largest_error(rendering.image, expectation.truth, expectation.feasible),
        judgement=judged.judgement,
        stochastic=judged.test,
        images=_written(rendering, judged, truth, place, folder),
    )


def _truth_of(place: CellPlace, expectation: Expectation, folder: Path) -> tuple[str, Expectation]:
    """The file with the truth of this cell, which is its own unless it is that of pixels' centres, and what it is."""
    name = TRUTH_FILE
    if place.integrator.follows == "light paths":
        name, expectation = AREA_MEANS_FILE, of_pixel_areas(expectation)
    elif expectation.camera_rays == CENTRES:
        return f"cells/{place.scene.name}/{TRUTH_FILE}", expectation
    write_image(folder / name, expectation.truth.astype(np.float32))
    return f"{place.folder}/{name}", expectation


def _judged_image(rendering: Rendering, place: CellPlace, expectation: Expectation) -> ImageVerdict:
    """The verdict by the test that the image asks for."""
    assert rendering.image is not None
    if place.integrator.follows == "light paths":
        return judge_light_paths(rendering, expectation)
    if rendering.batch_means is not None:
        return judge_noisy(rendering, expectation)
    return judge_exact(rendering.image, expectation)


def _costliest_line(place: CellPlace, expectation: Expectation) -> str:
    """Which line of what the renderer declares keeps most pixels from being judged, in words; nothing if none does."""
    error_model = error_model_of(place.renderer, place.version)
    unjudged = np.argwhere(expectation.feasible.outcomes == 0)
    if error_model is None or not len(unjudged):
        return ""
    pixels = [(column, row) for row, column in unjudged.tolist()]
    return costliest_line(place.scene, error_model.in_scene(place.scene), pixels)


def _displaced(place: CellPlace) -> str | None:
    """Why means over pixels are not known well enough for this renderer's ray offset; None if they are."""
    error_model = error_model_of(place.renderer, place.version)
    if place.integrator.follows != "light paths" or error_model is None:
        return None
    displacement = largest_displacement(place.scene, error_model.ray_offset)
    if displacement <= 1.0:
        return None
    return (
        f"rays start beside the surface, up to {displacement:.3g} times as far as the bounds on a pixel's mean allow: "
        "its ray offset is not small in this scene"
    )


def _names(place: CellPlace) -> dict[str, Any]:
    """What tells the cell apart, whether it was rendered or not."""
    return {
        "scene": place.scene.name,
        "renderer": place.renderer.name,
        "integrator": place.integrator.name,
        "command": place.command,
        "key": place.key,
    }


def _circumstances(place: CellPlace, folder: Path) -> dict[str, Any]:
    """What is told of a cell that was rendered, whatever came of it."""
    log = f"{place.folder}/{LOG_FILE}" if (folder / LOG_FILE).exists() else None
    return _names(place) | {"source": place.source, "version": place.version, "log": log}


def _written(rendering: Rendering, judged: ImageVerdict, truth: str, place: CellPlace, folder: Path) -> Images:
    """Write the images of the cell; `truth` is the one that it was judged by."""
    assert rendering.image is not None, "first hits alone have no images"
    write_image(folder / "render.exr", rendering.image.astype(np.float32))
    write_image(folder / "tolerances.exr", _in_float32(judged.distances))
    write_pixel_evidence(folder / "feasible.exr", judged.pixels)
    images = Images(
        render=f"{place.folder}/render.exr",
        truth=truth,
        tolerances=f"{place.folder}/tolerances.exr",
        feasible=f"{place.folder}/feasible.exr",
        variance=_write_variance(rendering, place, folder),
    )
    # The truth of the scene lies beside the folders of its cells, and what is unfinished lies beside its place.
    files = (folder.parent / Path(path).relative_to(Path(place.folder).parent) for path in images.paths)
    own = (folder / path.name if path.parent.name == Path(place.folder).name else path for path in files)
    return images.model_copy(update={"digest": files_digest(own)})


def _check_sizes(rendering: Rendering, gives: str, truth: NDArray[np.float64]) -> None:
    """Raises RendererError where what the integrator gives is missing, or of another size than the truth."""
    if (rendering.first_hits if gives == "first hits" else rendering.image) is None:
        raise RendererError(f"expected {gives}, got nothing")
    if rendering.image is not None and rendering.image.shape != truth.shape:
        raise RendererError(f"expected an image of shape {truth.shape}, got {rendering.image.shape}")
    if rendering.image is not None and np.isnan(rendering.image).any():
        y, x = np.argwhere(np.isnan(rendering.image).any(axis=2))[0]
        count = int(np.isnan(rendering.image).any(axis=2).sum())
        raise RendererError(f"{count} pixels of its image are not a number, the first of them ({x}, {y})")
    if rendering.first_hits is not None:
        for name, values in vars(rendering.first_hits).items():
            expected = truth.shape if name in {"position", "normal"} else truth.shape[:2]
            if values.shape != expected:
                raise RendererError(f"expected {name} of first hits of shape {expected}, got {values.shape}")


def _in_float32(distances: NDArray[np.float64]) -> NDArray[np.float32]:
    """The distances, those above 1 still above it."""
    with np.errstate(over="ignore"):  # infinitely far, as far as a reader can tell
        rounded = distances.astype(np.float32)
    just_outside = np.nextafter(np.float32(1), np.float32(2))
    return np.where(distances > 1, np.maximum(rounded, just_outside), rounded)


def _write_variance(rendering: Rendering, place: CellPlace, folder: Path) -> str | None:
    """The variance of the mean, estimated from the batches."""
    if rendering.batch_means is None:
        return None
    variance = rendering.batch_means.var(axis=0, ddof=1, dtype=np.float64) / len(rendering.batch_means)
    write_image(folder / "variance.exr", variance.astype(np.float32))
    return f"{place.folder}/variance.exr"
