"""Measures of how different two pictures look, taken in a child process, since FLIP can end its process or hang."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.records.renderings import Image

WORKER = Path(__file__).with_name("picture_metrics_worker.py")
# The worker ends itself when a pair takes too long; this only stops one that hangs at its start.
SECONDS_TO_START = 300.0
SECONDS_A_PIXEL = 1e-3
# Address space that the libraries and their threads reserve, and float64 temporaries: 50 images of three channels.
LIBRARY_BYTES = 4 << 30
BYTES_A_PIXEL = 50 * 3 * 8

# FLIP's threads wait for one another by spinning: with two on pictures of 96x72 it takes 90 ms of processor time, with
# one 7 ms, and gives the same numbers. Batches of pairs are side by side anyway.
ENVIRONMENT = {"OMP_NUM_THREADS": "1"}

MEASURED_FILE = "measured.jsonl"


def picture_metrics(pairs: Sequence[tuple[Image, Image]]) -> list[dict[str, float | None]]:
    """For each pair of a render and the truth the measures `ssim`, `delta_e_2000` and `flip`, as far as they exist.

    Images are finite, linear, of shape (height, width, 3), and clipped to [0, 1] before they are made sRGB pictures.
    A pair that ends the child process or hangs lacks the measures not taken by then; the others are not affected.
    """
    measured: list[dict[str, float | None]] = [{} for _ in pairs]
    with TemporaryDirectory() as name:
        folder = Path(name)
        for number, (render, truth) in enumerate(pairs):
            np.save(folder / f"{number}-render.npy", render)
            np.save(folder / f"{number}-truth.npy", truth)
        first = 0
        while first < len(pairs):
            _run_worker(folder, range(first, len(pairs)), pairs)
            first = _read_measured(folder, measured, first)
    return measured


def _run_worker(folder: Path, numbers: range, pairs: Sequence[tuple[Image, Image]]) -> None:
    pixels = [pairs[number][0][..., 0].size for number in numbers]
    command = [sys.executable, "-P", str(WORKER), *map(str, numbers)]
    (folder / MEASURED_FILE).touch()  # what was there before stays there when a run fails
    try:
        run_isolated(
            command,
            folder,
            seconds=SECONDS_TO_START + SECONDS_A_PIXEL * sum(pixels),
            memory_bytes=LIBRARY_BYTES + BYTES_A_PIXEL * max(pixels),
            environment=ENVIRONMENT,
        )
    except RendererError:
        return  # what it measured until then is in its file, and the caller goes on behind the pair that stopped it


def _read_measured(folder: Path, measured: list[dict[str, float | None]], first: int) -> int:
    """Take over what the worker measured; the number of the pair to go on with: that behind the one that failed."""
    path = folder / MEASURED_FILE
    *lines, _ = path.read_text(encoding="utf-8").split("\n")  # behind the last line end is nothing, or half a line
    for line in lines:
        values = json.loads(line)
        number = values.pop("pair")
        measured[number] |= values
    path.unlink()
    return next((number for number in range(first, len(measured)) if "flip" not in measured[number]), len(measured)) + 1
