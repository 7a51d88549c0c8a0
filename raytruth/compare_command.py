"""`raytruth compare`: the viewer for any two images."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.records.image_files import ImageError, read_image
from raytruth.errors import UsageError
from raytruth.judge_command import judge
from raytruth.output import say
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.comparison_page import comparison_page

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import Image


def compare(first: Path, second: Path, /, *, scene: str | None = None, out: Path | None = None) -> int:
    """Show two images in the viewer of the report.

    Parameters
    ----------
    first
        An OpenEXR image of three channels, linear.
    second
        Another of the same size.
    scene
        A scene of the library, or the path of a .json file: both images are judged as `raytruth judge` does, and shown
        with the truth.
    out
        Where to write: a page, comparison.html by default; with --scene a folder, comparison by default.
    """
    if scene is not None:
        return judge(first, second, scene=scene, out=out or Path("comparison"))
    path = out or Path("comparison.html")
    if path.is_dir():
        raise UsageError(f"--out: expected the name of a page, but {path} is a folder.")
    images = [_opened(file) for file in (first, second)]
    if images[0].shape != images[1].shape:
        sizes = " and ".join(f"{image.shape[1]}×{image.shape[0]}" for image in images)
        raise UsageError(f"{first}, {second}: expected two images of one size, found {sizes} pixels.")
    names = (first.name, second.name) if first.name != second.name else (str(first), str(second))
    write_whole(path, comparison_page(names, (images[0], images[1])))
    say(f"Comparison: {path}")
    return 0


def _opened(file: Path) -> Image:
    try:
        image = read_image(file)
    except ImageError as error:
        raise UsageError(f"{error}.") from error
    if image.ndim != 3:
        raise UsageError(f"{file}: expected an image with R, G and B, found one channel.")
    return image
