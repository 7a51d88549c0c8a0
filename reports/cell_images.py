"""The images of a cell, each read from the results when it is wanted, and once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from raytruth.reports import pictures
from raytruth.reports.loading import ReportError, read_colours, read_evidence, read_values

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.pixel_evidence import PixelEvidence
    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.records.results import Images


@dataclass(frozen=True)
class CellImages:
    """Each raises ReportError, in one sentence, where it is missing or broken."""

    directory: Path
    paths: Images
    place: str
    """Of which scene and renderer they are, in words."""

    @cached_property
    def truth(self) -> Image:
        """Linear, shape (height, width, 3)."""
        return read_colours(self.directory, self.paths.truth)

    @cached_property
    def render(self) -> Image:
        """Linear, of the truth's shape (height, width, 3)."""
        render = read_colours(self.directory, self.paths.render)
        if render.shape != self.truth.shape:
            raise ReportError(f"The render is {_size(render)} pixels large, the truth {_size(self.truth)}.")
        return render

    @cached_property
    def distances(self) -> Image:
        """Of each channel from the middle of the nearest outcome in tolerances, shape (height, width, 3)."""
        return read_colours(self.directory, self.paths.tolerances)

    @cached_property
    def evidence(self) -> PixelEvidence:
        """What the pixels are held to."""
        return read_evidence(self.directory, self.paths.feasible)

    @cached_property
    def variance(self) -> Image | None:
        """Of a renderer that draws random numbers, shape (height, width, 3) or (height, width); None of another."""
        if self.paths.variance is None:
            return None
        try:
            return read_colours(self.directory, self.paths.variance)
        except ReportError:  # one channel will do as well
            return read_values(self.directory, self.paths.variance)

    @cached_property
    def stops(self) -> int:
        """The exposure that shows the truth well."""
        return pictures.exposure_stops(self.truth)


def _size(image: Image) -> str:
    return f"{image.shape[1]}×{image.shape[0]}"
