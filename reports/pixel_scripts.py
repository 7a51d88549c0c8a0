"""The values of a cell's pixels as a script beside the page, which loads it when somebody looks at a pixel.

A page that was opened from a file may load scripts and pictures from other files, but no data; and pictures hold only 8
bits a channel. So the numbers travel in a call of a function of the page's, as base64 of little-endian arrays.
"""

from __future__ import annotations

import base64
import json
import shlex
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import quote

import numpy as np

from raytruth.reports.loading import ReportError, read_colours, read_evidence

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import ArrayLike

    from raytruth.comparisons.records.results import Cell, Images

FOLDER = "pixels"
"""The folder of scripts, beside the page."""


@dataclass(frozen=True)
class PixelView:
    """What the page needs to know of a cell's pixels before it loads their values."""

    address: str
    """The script's path, relative to the page."""
    width: int
    height: int
    x: int
    """The pixel to look at first: the worst one."""
    y: int
    explain: str
    """The command that explains a pixel, but for its X,Y at the end."""
    is_mean: bool
    """Whether the values are means of random numbers."""


def write_pixel_script(directory: Path, cell: Cell, images: Images, anchor: str, folder: Path) -> PixelView:
    """Write the script of a cell into the folder. `anchor` is the cell's id on the page.

    Raises ReportError where an image is missing, broken or of another size, or the script cannot be written.
    """
    script, (height, width) = _script(directory, images, anchor)
    # One part of a path, whatever the names are: a quoted name holds neither a slash nor a plus sign.
    parts = (cell.scene, cell.renderer, cell.integrator)
    name = "+".join(quote(part, safe="") for part in parts) + ".js"
    try:
        folder.mkdir(exist_ok=True)
        (folder / name).write_text(script, encoding="ascii")
    except OSError as error:
        raise ReportError(f"The values of the pixels cannot be written to {name}: {error.strerror}.") from error
    worst = None if cell.judgement is None else cell.judgement.worst
    x, y = (0, 0) if worst is None else (worst.x, worst.y)
    explain = f"raytruth explain {shlex.quote(cell.source or cell.scene)} --pixel "
    address = f"{FOLDER}/{quote(name, safe='+')}"
    return PixelView(address, width, height, x, y, explain, cell.stochastic is not None)


def _script(directory: Path, images: Images, anchor: str) -> tuple[str, tuple[int, int]]:
    """The script, and the height and width of the images."""
    value = read_colours(directory, images.render)
    truth = read_colours(directory, images.truth)
    distances = read_colours(directory, images.tolerances)
    evidence = read_evidence(directory, images.feasible)
    height, width = value.shape[:2]
    if len({image.shape[:2] for image in (value, truth, distances, evidence.low)}) > 1:
        raise ReportError("The values of the pixels cannot be shown: the cell's images differ in size.")
    used = ~np.isnan(evidence.low).any(axis=3)
    data = {
        "width": width,
        "height": height,
        "value": _packed(value, "<f4"),
        "truth": _packed(truth, "<f4"),
        "distance": _packed(distances, "<f4"),
        "outcomes": _packed(used.sum(axis=2), "u1"),
        "nearest": _packed(evidence.nearest, "u1"),
        "merged": _packed(evidence.merged, "u1"),
        "declared": _packed(evidence.declared, "u1"),
        "low": _packed(evidence.low[used], "<f4"),
        "high": _packed(evidence.high[used], "<f4"),
    }
    return f"raytruthPixels({json.dumps(anchor)}, {json.dumps(data)});\n", (height, width)


def _packed(array: ArrayLike, kind: str) -> str:
    """The array's numbers in rows, deflated, in base64."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).astype(kind).tobytes())).decode("ascii")
