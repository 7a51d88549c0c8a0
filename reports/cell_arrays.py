"""The float values of a cell's pixels for the page that shows them, and what that page must know before they come.

Arrays travel as base64 of their deflated bytes. Bytes of the same significance stand together, the least significant
ones first: so zlib finds the exponents of neighbours, which are alike, side by side.
"""

from __future__ import annotations

import base64
import shlex
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reports.loading import ReportError
from raytruth.reports.script_data import script_json
from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from raytruth.comparisons.records.pixel_evidence import PixelEvidence
    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.records.results import Cell
    from raytruth.reports.cell_images import CellImages
    from raytruth.reports.parts import Parts


def cell_arrays(images: CellImages, parts: Parts) -> dict[str, str]:
    """Store the arrays of a cell, and return their names: `truth`, `render` and `judgement`, each to be loaded alone.

    Raises ReportError where an image is missing, broken or of another size.
    """
    truth, render, distances, evidence = images.truth, images.render, images.distances, images.evidence
    if len({image.shape[:2] for image in (truth, render, distances, evidence.low)}) > 1:
        raise ReportError("The values of the pixels cannot be shown: the cell's images differ in size.")
    names = {
        "truth": parts.add_arrays(script_json({"value": packed(truth, "<f4")})),
        "render": parts.add_arrays(script_json({"value": packed(render, "<f4")})),
        "judgement": parts.add_arrays(script_json(_judgement(distances, evidence))),
    }
    if images.variance is not None:
        names["variance"] = parts.add_arrays(script_json({"value": packed(images.variance, "<f4")}))
    return names


def _judgement(distances: Image, evidence: PixelEvidence) -> dict[str, Any]:
    used = ~np.isnan(evidence.low).any(axis=3)
    return {
        "distance": packed(distances, "<f4"),
        "outcomes": packed(used.sum(axis=2), "u1"),
        "nearest": packed(evidence.nearest, "u1"),
        "merged": packed(evidence.merged, "u1"),
        "declared": packed(evidence.declared, "u1"),
        "low": packed(evidence.low[used], "<f4"),
        "high": packed(evidence.high[used], "<f4"),
    }


def packed(array: ArrayLike, kind: str) -> dict[str, str | list[int]]:
    """An array in JSON: its shape, its kind (`<f4` or `u1`), and its bytes, deflated, in base64."""
    numbers = np.ascontiguousarray(array).astype(kind)
    planes = np.frombuffer(numbers.tobytes(), dtype=np.uint8).reshape(-1, numbers.itemsize).T
    return {
        "shape": list(numbers.shape),
        "kind": kind,
        "bytes": base64.b64encode(zlib.compress(planes.tobytes())).decode("ascii"),
    }


def viewer_data(cell: Cell, images: CellImages, arrays: dict[str, str]) -> dict[str, Any]:
    """What the page knows of a cell before its arrays come; `others` is for the renders of the scene by others."""
    height, width = images.truth.shape[:2]
    worst = None if cell.judgement is None else cell.judgement.worst
    return {
        "width": width,
        "height": height,
        "worst": [0, 0] if worst is None else [worst.x, worst.y],
        "explain": printable(f"raytruth explain {shlex.quote(cell.source or cell.scene)} --pixel "),
        "isMean": cell.stochastic is not None,
        "stops": images.stops,
        "arrays": arrays,
        "others": [],
    }
