"""The pictures of a cell with their captions, ready for the page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from raytruth.reports import pictures
from raytruth.reports.loading import ReportError
from raytruth.reports.wording import number, plural

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.reports.cell_images import CellImages
    from raytruth.reports.parts import Parts

ENLARGE_BELOW = 320
"""Images narrower than this many pixels are shown enlarged, as squares: about the width of a figure on the page."""


@dataclass(frozen=True)
class Figure:
    """One picture of a cell; one of `picture` and `problem` is set."""

    title: str
    caption: str = ""
    alt: str = ""
    width: int = 0
    height: int = 0
    picture: str | None = None
    """The name of the picture among the parts of the report."""
    legend: str | None = None
    """`difference`, `tolerances` or `sequential`: the scale to print below the picture."""
    low: str = ""
    high: str = ""
    problem: str | None = None

    @property
    def enlarged(self) -> bool:
        """Whether to show its pixels as squares."""
        return self.width < ENLARGE_BELOW


def cell_figures(images: CellImages, parts: Parts) -> list[Figure]:
    """Truth, render, signed difference and error map of a cell; a figure that cannot be made says why."""
    builders: dict[str, Callable[[CellImages, Parts], Figure]] = {
        "Truth": _truth,
        "Render": _render,
        "Signed difference": _difference,
        "Error map": _error_map,
    }
    if images.paths.variance is not None:
        builders["Standard deviation"] = _deviation
    figures = []
    for title, build in builders.items():
        try:
            figures.append(build(images, parts))
        except ReportError as error:
            figures.append(Figure(title=title, problem=str(error)))
    return figures


def _truth(images: CellImages, parts: Parts) -> Figure:
    height, width = images.truth.shape[:2]
    picture = parts.add_picture(pictures.tone_picture(images.truth, images.stops))
    return Figure("Truth", _tone_caption(images.stops), f"Truth of {images.place}", width, height, picture)


def _render(images: CellImages, parts: Parts) -> Figure:
    render = images.render
    height, width = render.shape[:2]
    caption = _tone_caption(images.stops)
    strange = int((~np.isfinite(render).all(axis=-1)).sum())
    if strange:
        caption += f"; not a finite number at {strange} {plural('pixel', strange)} (magenta)"
    picture = parts.add_picture(pictures.tone_picture(render, images.stops))
    return Figure("Render", caption, f"Render of {images.place}", width, height, picture)


def _difference(images: CellImages, parts: Parts) -> Figure:
    difference = pictures.signed_difference(images.render, images.truth)
    height, width = difference.shape
    scale = pictures.largest_finite(difference)
    caption = "render − truth, the channel that differs most" if scale else "render − truth: no difference"
    if not np.isfinite(difference).all():
        caption += "; black: not a finite number"
    return Figure(
        "Signed difference",
        caption,
        f"Signed difference of {images.place} from the truth, up to {number(scale)}",
        width,
        height,
        parts.add_picture(pictures.difference_picture(difference, scale)),
        legend="difference" if scale else None,
        low=f"−{number(scale)}",
        high=f"+{number(scale)}",
    )


def _error_map(images: CellImages, parts: Parts) -> Figure:
    tolerances = images.distances.max(axis=-1)
    height, width = tolerances.shape
    picture = parts.add_picture(pictures.tolerance_picture(tolerances))
    alt = f"Error map of {images.place} in units of the tolerance"
    caption = "error in units of the pixel’s tolerance, the channel that is farthest"
    return Figure("Error map", caption, alt, width, height, picture, legend="tolerances", low="0", high="1")


def _deviation(images: CellImages, parts: Parts) -> Figure:
    variance = images.variance
    if variance is None:
        raise ReportError("There is no variance.")
    height, width = variance.shape[:2]
    png, scale = pictures.deviation_picture(variance)
    return Figure(
        "Standard deviation",
        "square root of the variance, the channel that varies most",
        f"Standard deviation of {images.place}, up to {number(scale)}",
        width,
        height,
        parts.add_picture(png),
        legend="sequential",
        low="0",
        high=number(scale),
    )


def _tone_caption(stops: int) -> str:
    brightened = f", exposure {stops:+d} {plural('stop', stops)}" if stops else ""
    return f"sRGB{brightened}"
