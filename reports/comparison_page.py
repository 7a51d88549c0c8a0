"""Any two images in the viewer, as one page: nothing is known of what is right, and nothing is judged."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.reports import pages, pictures
from raytruth.reports.cell_arrays import packed
from raytruth.reports.figures import Figure
from raytruth.reports.parts import Parts
from raytruth.reports.script_data import script_json
from raytruth.reports.wording import number

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import Image


def comparison_page(names: tuple[str, str], images: tuple[Image, Image]) -> str:
    """The page of two linear images of the same shape (height, width, 3), with the names of their files."""
    parts = Parts()
    first, second = images
    height, width = first.shape[:2]
    stops = pictures.exposure_stops(first)
    difference = pictures.signed_difference(second, first)
    scale = pictures.largest_finite(difference)
    shown = [pictures.tone_picture(image, stops) for image in images]
    figures = [
        *(
            Figure(name, "", name, width, height, parts.add_picture(png))
            for name, png in zip(names, shown, strict=True)
        ),
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
    place = np.nan_to_num(np.abs(difference), nan=np.inf).argmax()
    viewer = {
        "width": width,
        "height": height,
        "worst": [int(place % width), int(place // width)],
        "names": list(names),
        "isMean": False,
        "stops": stops,
        "arrays": {
            "truth": parts.add_arrays(script_json({"value": packed(first, "<f4")})),
            "render": parts.add_arrays(script_json({"value": packed(second, "<f4")})),
        },
        "others": [],
    }
    same = int((first.view(np.uint32) == second.view(np.uint32)).all(axis=2).sum())
    sentence = f"{same} of {width * height} pixels are the same, bit by bit; the largest difference is {number(scale)}."
    return pages.comparison(parts, {"names": names, "figures": figures, "viewer": viewer, "sentence": sentence})
