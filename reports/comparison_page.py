"""Any two images in the viewer, as one page: nothing is known of what is right, and nothing is judged."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.reports import pages, pictures
from raytruth.reports.cell_arrays import packed
from raytruth.reports.figures import Figure
from raytruth.reports.parts import Parts
from raytruth.reports.script_data import script_json
from raytruth.reports.wording import number, printable

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import Image


def comparison_page(names: tuple[str, str], images: tuple[Image, Image]) -> str:
    """The page of two linear images of the same shape (height, width, 3), with the names of their files."""
    parts = Parts()
    first, second = images
    difference = pictures.signed_difference(second, first)
    same = int((first.view(np.uint32) == second.view(np.uint32)).all(axis=2).sum())
    largest = number(pictures.largest_finite(difference))
    sentence = f"{same} of {difference.size} pixels are the same, bit by bit; the largest difference is {largest}."
    contents = {
        "names": names,
        "figures": _figures(names, images, difference, parts),
        "viewer": _viewer(names, images, difference, parts),
        "sentence": sentence,
    }
    return pages.comparison(parts, contents)


def _figures(names: tuple[str, str], images: tuple[Image, Image], difference: Image, parts: Parts) -> list[Figure]:
    height, width = difference.shape
    stops = pictures.exposure_stops(images[0])
    shown = [parts.add_picture(pictures.tone_picture(image, stops)) for image in images]
    scale = pictures.largest_finite(difference)
    return [
        *(Figure(name, "", name, width, height, png) for name, png in zip(names, shown, strict=True)),
        Figure(
            "Signed difference",
            "the second minus the first, the channel that differs most",
            "Signed difference",
            width,
            height,
            parts.add_picture(pictures.difference_picture(difference, scale)),
            legend="difference" if scale else None,
            low=f"−{number(scale)}",
            high=f"+{number(scale)}",
        ),
    ]


def _viewer(names: tuple[str, str], images: tuple[Image, Image], difference: Image, parts: Parts) -> dict[str, object]:
    """As `viewer_data` for a cell, without what judges it."""
    height, width = difference.shape
    place = int(np.nan_to_num(np.abs(difference), nan=np.inf).argmax())
    arrays = [parts.add_arrays(script_json({"value": packed(image, "<f4")})) for image in images]
    return {
        "width": width,
        "height": height,
        "worst": [place % width, place // width],
        "names": [printable(name) for name in names],
        "isMean": False,
        "stops": pictures.exposure_stops(images[0]),
        "arrays": dict(zip(("truth", "render"), arrays, strict=True)),
        "others": [],
    }
