"""The pictures of a cell with their captions, ready for the page."""

from __future__ import annotations

import base64
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from raytruth.reports import pictures
from raytruth.reports.loading import ReportError, read_colours, read_values
from raytruth.reports.wording import number, plural

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.records.results import Cell, Images

ENLARGE_BELOW = 320
"""Images narrower than this many pixels are shown enlarged, as squares: about the width of a figure on the page."""


@dataclass(frozen=True)
class SharedPicture:
    """A picture stored once on the page and shown in many places."""

    name: str
    uri: str
    width: int
    height: int


@dataclass
class Album:
    """The shared pictures of a page by their content: the truth of a scene belongs to each of its cells."""

    pictures: dict[bytes, SharedPicture] = field(default_factory=dict)

    def add(self, png: bytes, width: int, height: int) -> SharedPicture:
        """Store the picture once on the page; the same content again gives the same shared picture."""
        new = SharedPicture(f"picture-{len(self.pictures) + 1}", data_uri(png), width, height)
        return self.pictures.setdefault(png, new)


@dataclass(frozen=True)
class Figure:
    """One picture of a cell; one of `shared`, `uri` and `problem` is set."""

    title: str
    caption: str = ""
    alt: str = ""
    width: int = 0
    height: int = 0
    shared: SharedPicture | None = None
    uri: str | None = None
    legend: str | None = None
    """`difference`, `tolerances` or `sequential`: the scale to print below the picture."""
    low: str = ""
    high: str = ""
    problem: str | None = None

    @property
    def enlarged(self) -> bool:
        """Whether to show its pixels as squares."""
        return self.width < ENLARGE_BELOW


def data_uri(png: bytes) -> str:
    """The PNG as an address that holds its own content."""
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def cell_figures(directory: Path, cell: Cell, album: Album) -> list[Figure]:
    """Truth, render, signed difference and error map of a cell; a figure that cannot be made says why."""
    if cell.images is None:
        return []
    source = Source(directory, cell.images, f"{cell.scene} by {cell.renderer}/{cell.integrator}", album)
    builders: dict[str, Callable[[Source], Figure]] = {
        "Truth": _truth,
        "Render": _render,
        "Signed difference": _difference,
        "Error map": _error_map,
    }
    if cell.images.variance is not None:
        builders["Standard deviation"] = _deviation
    figures = []
    for title, build in builders.items():
        try:
            figures.append(build(source))
        except ReportError as error:
            figures.append(Figure(title=title, problem=str(error)))
    return figures


@dataclass(frozen=True)
class Source:
    """The truth and the render of a cell, as its figures need them."""

    directory: Path
    images: Images
    place: str
    album: Album

    def truth(self) -> Image:
        """The truth, shape (height, width, 3)."""
        return read_colours(self.directory, self.images.truth)

    def render(self) -> Image:
        """The render, of the truth's shape (height, width, 3)."""
        render, truth = read_colours(self.directory, self.images.render), self.truth()
        if render.shape != truth.shape:
            raise ReportError(f"The render is {_size(render)} pixels large, the truth {_size(truth)}.")
        return render


def _truth(source: Source) -> Figure:
    truth = source.truth()
    height, width = truth.shape[:2]
    stops = pictures.exposure_stops(truth)
    shared = source.album.add(pictures.tone_picture(truth, stops), width, height)
    return Figure("Truth", _tone_caption(stops), f"Truth of {source.place}", width, height, shared=shared)


def _render(source: Source) -> Figure:
    render = source.render()
    height, width = render.shape[:2]
    stops = pictures.exposure_stops(source.truth())
    caption = _tone_caption(stops)
    strange = int((~np.isfinite(render).all(axis=-1)).sum())
    if strange:
        caption += f"; not a finite number at {strange} {plural('pixel', strange)} (magenta)"
    uri = data_uri(pictures.tone_picture(render, stops))
    return Figure("Render", caption, f"Render of {source.place}", width, height, uri=uri)


def _difference(source: Source) -> Figure:
    difference = pictures.signed_difference(source.render(), source.truth())
    height, width = difference.shape
    scale = pictures.largest_finite(difference)
    caption = "render − truth, the channel that differs most" if scale else "render − truth: no difference"
    if not np.isfinite(difference).all():
        caption += "; black: not a finite number"
    return Figure(
        "Signed difference",
        caption,
        f"Signed difference of {source.place} from the truth, up to {number(scale)}",
        width,
        height,
        uri=data_uri(pictures.difference_picture(difference, scale)),
        legend="difference" if scale else None,
        low=f"−{number(scale)}",
        high=f"+{number(scale)}",
    )


def _error_map(source: Source) -> Figure:
    tolerances = read_colours(source.directory, source.images.tolerances).max(axis=-1)
    height, width = tolerances.shape
    uri = data_uri(pictures.tolerance_picture(tolerances))
    alt = f"Error map of {source.place} in units of the tolerance"
    caption = "error in units of the pixel’s tolerance, the channel that is farthest"
    return Figure("Error map", caption, alt, width, height, uri=uri, legend="tolerances", low="0", high="1")


def _deviation(source: Source) -> Figure:
    path = source.images.variance or ""
    try:
        variance = read_colours(source.directory, path)
    except ReportError:  # one channel will do as well
        variance = read_values(source.directory, path)
    height, width = variance.shape[:2]
    png, scale = pictures.deviation_picture(variance)
    return Figure(
        "Standard deviation",
        "square root of the variance, the channel that varies most",
        f"Standard deviation of {source.place}, up to {number(scale)}",
        width,
        height,
        uri=data_uri(png),
        legend="sequential",
        low="0",
        high=number(scale),
    )


def _tone_caption(stops: int) -> str:
    brightened = f", exposure {stops:+d} {plural('stop', stops)}" if stops else ""
    return f"sRGB{brightened}"


def _size(image: Image) -> str:
    return f"{image.shape[1]}×{image.shape[0]}"
