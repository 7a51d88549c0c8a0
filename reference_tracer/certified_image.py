"""The certified image of a scene: bands of rows, proven side by side, and kept.

A band is a file in the cache, written whole or not at all, so that an image that was interrupted goes on where it
stopped. Its folder is named by all that the image depends on: the scene, our code, and the library of balls.
"""

from __future__ import annotations

import gc
import hashlib
import json
import zipfile
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any

import flint
import numpy as np

from raytruth.reference_tracer.camera_rays import CENTRES
from raytruth.reference_tracer.certification import (
    TWO_ROUNDINGS,
    CertifiedPixel,
    Certifier,
    Enclosure,
    Undecided,
    agree,
)
from raytruth.reference_tracer.compiled_truth import COMPILED_BITS, CompiledTruth
from raytruth.reference_tracer.storage.cache import cache_folder, keep
from raytruth.reference_tracer.storage.source_digest import source_digest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.reference_tracer.compiled_truth import EnclosedRows
    from raytruth.scenes.scene import Scene

# A second or so of work, so that little is lost when a run is interrupted, and no process is left alone for long.
PIXELS_IN_A_BAND = 2048
# A process starts in the time that Arb's balls take for so many pixels: a second or so.
PIXELS_WORTH_A_PROCESS = 1000

TRUTH_ROOMS = (
    "scenes",
    "reference_tracer",
    "reference_tracer/arithmetics",
    "reference_tracer/compiler",
    "reference_tracer/source",
    "reference_tracer/storage",
)
"""What an enclosure depends on: how a scene is read, what it says, and how that is evaluated."""

Pixel = tuple[int, int]
"""Column and row."""


@dataclass(frozen=True)
class CertifiedImage:
    """Enclosures of all pixels of rows that follow each other, row 0 on top.

    Undecided pixels have the enclosure of all their outcomes, or infinite values where there is none.
    """

    middle: NDArray[np.float64]
    """Shape (rows, width, 3), linear RGB."""
    radius: NDArray[np.float64]
    """Shape (rows, width, 3)."""
    precision_bits: NDArray[np.int64]
    """Shape (rows, width): with how many bits each pixel was evaluated in the end."""
    undecided: dict[Pixel, Undecided]

    @property
    def decided(self) -> NDArray[np.bool_]:
        """Where the value is proven; shape (rows, width)."""
        decided = np.ones(self.precision_bits.shape, dtype=bool)
        for column, row in self.undecided:
            decided[row, column] = False
        return decided


@dataclass(frozen=True, eq=False)
class _Band:
    """Rows `first` to `end` - 1 of a scene's image by these rays, and the folder where they are kept."""

    scene: Scene
    camera_rays: CameraRays
    first: int
    end: int
    folder: Path

    @property
    def file(self) -> Path:
        return self.folder / f"rows-{self.first}-{self.end}.npz"


def certified_image(
    scene: Scene,
    camera_rays: CameraRays = CENTRES,
    *,
    jobs: int = 1,
    fresh: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> CertifiedImage:
    """The certified image of a scene at its own size, made by `jobs` threads and processes, or by this one for 1.

    Compiled balls prove most pixels (compiled_truth.py); what they leave undecided or wide is worked out by Arb's.
    Bands that are kept from before are used unless `fresh`. `progress` is told how many bands of how many are done.
    The radius of a decided pixel is at most 2^-52 of the image's largest value: pixels that miss that at first are
    evaluated with more bits once that value is known. Ties whose outcomes differ by no more than that decide nothing.
    """
    bands = _bands(scene, camera_rays)
    images = {} if fresh else {band: image for band in bands if (image := _read(band)) is not None}
    missing = [band for band in bands if band not in images]
    for band, image in _certified_bands(missing, jobs):
        images[band] = image
        if progress is not None:
            progress(len(images), len(bands))
    widest = TWO_ROUNDINGS * largest_value(images.values())
    wide = [
        (band, image, widest)
        for band, image in images.items()
        if _is_wide(image, widest).any() or _ties_without_consequence(image, widest)
    ]
    left = sum(int(_is_wide(image, widest).sum()) for _, image, _ in wide)
    images.update(_side_by_side(_refined_band, wide, _processes_for(left, jobs)))
    return _joined([(band, images[band]) for band in bands])


def largest_value(images: Iterable[CertifiedImage]) -> float:
    """A value that some decided pixel is proven to reach; 0 if there is none."""
    proven = ((image.middle[image.decided], image.radius[image.decided]) for image in images)
    return max(float(np.max(middle - radius, initial=0.0)) for middle, radius in proven)


def collect_garbage_rarely() -> None:
    """Balls come and go by the million and hold no cycles; looking for some every 700 takes a tenth of the time."""
    gc.set_threshold(100_000)


def truth_key(scene: Scene, camera_rays: CameraRays = CENTRES) -> str:
    """A digest of all that a certified image depends on: the scene, the pixels' rays, our code, and the libraries."""
    versions = (flint.__version__, flint.__FLINT_VERSION__, np.__version__)
    parts = (scene.model_dump_json(), repr(camera_rays), source_digest(*TRUTH_ROOMS), *versions)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def _bands(scene: Scene, camera_rays: CameraRays) -> list[_Band]:
    folder = cache_folder() / "truth" / truth_key(scene, camera_rays)
    rows = max(1, PIXELS_IN_A_BAND // scene.camera.width)
    height = scene.camera.height
    return [_Band(scene, camera_rays, first, min(first + rows, height), folder) for first in range(0, height, rows)]


Work = tuple[Any, ...]
"""A band, and whatever else the function takes."""


def _side_by_side(
    function: Callable[..., CertifiedImage], work: Sequence[Work], jobs: int
) -> Iterator[tuple[_Band, CertifiedImage]]:
    """The bands as they are finished. When the caller stops early, what runs is finished and the rest is dropped."""
    if jobs == 1 or len(work) <= 1:
        yield from ((arguments[0], function(*arguments)) for arguments in work)
        return
    # Fresh interpreters: threads of a forked one may hold locks for ever.
    with ProcessPoolExecutor(min(jobs, len(work)), get_context("spawn"), collect_garbage_rarely) as pool:
        waiting = {pool.submit(function, *arguments): arguments[0] for arguments in work}
        try:
            for finished in as_completed(waiting):
                yield waiting[finished], finished.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _certified_bands(bands: Sequence[_Band], jobs: int) -> Iterator[tuple[_Band, CertifiedImage]]:
    """The bands as they are finished: those that compiled balls prove first, then those that need Arb's."""
    unfinished: list[Work] = []
    for band, begun in _begun(bands, jobs):
        image = CertifiedImage(begun.middle, begun.radius, np.full(begun.decided.shape, COMPILED_BITS), {})
        if begun.decided.all():
            _write(band, image)
            yield band, image
        else:
            unfinished.append((band, image, ~begun.decided))
    left = sum(int(pixels.sum()) for _, _, pixels in unfinished)
    yield from _side_by_side(_finished_band, unfinished, _processes_for(left, jobs))


def _processes_for(pixels: int, jobs: int) -> int:
    """How many processes are worth starting for pixels that need Arb's balls."""
    return min(jobs, 1 + pixels // PIXELS_WORTH_A_PROCESS)


def _begun(bands: Sequence[_Band], jobs: int) -> Iterator[tuple[_Band, EnclosedRows]]:
    """What compiled balls prove of the bands, in this order, made by threads."""
    if not bands:
        return
    scene, camera_rays = bands[0].scene, bands[0].camera_rays
    truth = CompiledTruth(scene, Certifier(scene, camera_rays).frame())
    threads = ThreadPoolExecutor(jobs)
    try:
        yield from zip(bands, threads.map(lambda band: truth.rows(band.first, band.end), bands), strict=True)
    finally:
        threads.shutdown(cancel_futures=True)


def _finished_band(band: _Band, image: CertifiedImage, left: NDArray[np.bool_]) -> CertifiedImage:
    """With Arb's balls where pixels are left."""
    certifier = Certifier(band.scene, band.camera_rays)
    for row, column in np.argwhere(left).tolist():
        _put(image, column, row, certifier.pixel(column, band.first + row))
    _write(band, image)
    return image


def _refined_band(band: _Band, image: CertifiedImage, widest: float) -> CertifiedImage:
    """With more bits where a radius is above `widest`, and with the ties decided that matter less than that."""
    for pixel in _ties_without_consequence(image, widest):
        del image.undecided[pixel]
    certifier = Certifier(band.scene, band.camera_rays)
    for row, column in np.argwhere(_is_wide(image, widest)).tolist():
        _put(image, column, row, certifier.pixel(column, band.first + row, widest))
    _write(band, image)
    return image


def _is_wide(image: CertifiedImage, widest: float) -> NDArray[np.bool_]:
    """Which decided pixels have a radius above `widest`; none where all is black and so nothing is wide."""
    wide: NDArray[np.bool_] = image.decided & (image.radius.max(axis=2) > widest) & (widest > 0.0)
    return wide


def _ties_without_consequence(image: CertifiedImage, widest: float) -> list[Pixel]:
    """The undecided pixels all of whose outcomes are one value, as seen beside the image's largest."""
    return [
        (column, row)
        for (column, row), reason in image.undecided.items()
        if reason.outcomes and agree(_enclosure(image, column, row), widest)
    ]


def _enclosure(image: CertifiedImage, column: int, row: int) -> Enclosure:
    return Enclosure(tuple(image.middle[row, column].tolist()), tuple(image.radius[row, column].tolist()))


def _put(image: CertifiedImage, column: int, row: int, pixel: CertifiedPixel) -> None:
    image.middle[row, column] = pixel.middle
    image.radius[row, column] = pixel.radius
    image.precision_bits[row, column] = pixel.precision_bits
    if pixel.undecided is not None:
        image.undecided[column, row] = pixel.undecided


def _joined(bands: Sequence[tuple[_Band, CertifiedImage]]) -> CertifiedImage:
    images = [image for _, image in bands]
    return CertifiedImage(
        np.concatenate([image.middle for image in images]),
        np.concatenate([image.radius for image in images]),
        np.concatenate([image.precision_bits for image in images]),
        {
            (column, band.first + row): reason
            for band, image in bands
            for (column, row), reason in image.undecided.items()
        },
    )


def _write(band: _Band, image: CertifiedImage) -> None:
    undecided = json.dumps([[column, row, asdict(reason)] for (column, row), reason in image.undecided.items()])
    arrays = {"middle": image.middle, "radius": image.radius, "precision_bits": image.precision_bits}
    keep(band.file, lambda file: np.savez(file, allow_pickle=False, undecided=np.array(undecided), **arrays))


def _read(band: _Band) -> CertifiedImage | None:
    """The band as it was kept; None if it was not, or if its file is damaged."""
    try:
        with band.file.open("rb") as file, np.load(file) as arrays:
            undecided = {
                (column, row): _undecided(reason) for column, row, reason in json.loads(str(arrays["undecided"]))
            }
            return CertifiedImage(arrays["middle"], arrays["radius"], arrays["precision_bits"], undecided)
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def _undecided(document: dict[str, Any]) -> Undecided:
    outcomes = tuple(Enclosure(tuple(outcome["middle"]), tuple(outcome["radius"])) for outcome in document["outcomes"])
    return Undecided(
        tuple(document["origin"]),
        tuple(document["direction"]),
        outcomes,
        document["explanation"],
    )
