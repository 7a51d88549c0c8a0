"""Linear float images as OpenEXR files, read and written by OpenImageIO."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO

from raytruth.reference_tracer.storage.whole_files import unfinished_file
from raytruth.scenes.camera import LARGEST_SIDE

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

CHANNEL_NAMES = {1: ("Y",), 3: ("R", "G", "B")}
"""What OpenEXR calls the channels of a grey and of a colour image (Technical Introduction to OpenEXR, 2006)."""


NO_DATE = "1970:01:01 00:00:00"
"""In every file, instead of when it was written: so the same pixels are the same bytes."""


class ImageError(Exception):
    """A file that is not an image we can use, or cannot be written; the message is one sentence."""


def write_image(path: Path, image: NDArray[np.float32]) -> None:
    """Write linear float32 pixels of shape (height, width) or (height, width, 3) to an `.exr` file.

    The file appears whole or not at all. Raises ImageError if it cannot be written, ValueError for another shape or
    type of array.
    """
    channels = 1 if image.ndim == 2 else image.shape[-1]
    if image.ndim not in {2, 3} or channels not in CHANNEL_NAMES or image.size == 0 or image.dtype != np.float32:
        raise ValueError(f"expected float32 of shape (h, w) or (h, w, 3), got {image.dtype} of shape {image.shape}")
    write_channels(path, image.reshape(*image.shape[:2], channels), CHANNEL_NAMES[channels])


def write_channels(path: Path, image: NDArray[np.float32], names: Sequence[str]) -> None:
    """Write float32 channels of shape (height, width, channels) by their names.

    The file appears whole or not at all. Raises ImageError if it cannot be written.
    """
    height, width, channels = image.shape
    spec = OpenImageIO.ImageSpec(width, height, channels, "float")
    spec.channelnames = tuple(names)
    spec.attribute("DateTime", NO_DATE)
    try:
        with unfinished_file(path) as file:
            buffer = OpenImageIO.ImageBuf(spec)
            buffer.set_pixels(OpenImageIO.ROI.All, image)
            if not buffer.write(name_for_openimageio(file)):
                raise ImageError(f"{path}: the image could not be written ({error_text(buffer.geterror)})")
    except OSError as error:
        raise ImageError(f"{path}: the image could not be written ({error.strerror})") from error


def read_image(path: Path) -> NDArray[np.float32]:
    """The pixels of a one-part OpenEXR file: shape (height, width) for one channel, (height, width, 3) for R, G and B.

    Raises ImageError for a file that is missing, damaged, too large, or has other channels. Pixels that are not finite
    are left for the caller to judge.
    """
    one_or_three = "one channel or R, G and B"
    pixels, names = read_channels(path, lambda names: len(names) == 1 or names == CHANNEL_NAMES[3], one_or_three)
    return pixels[..., 0] if len(names) == 1 else pixels


def read_channels(
    path: Path, are_right: Callable[[tuple[str, ...]], bool], expected: str
) -> tuple[NDArray[np.float32], tuple[str, ...]]:
    """The pixels of a one-part OpenEXR file, shape (height, width, channels), and the names of its channels.

    Raises ImageError for a file that is missing, damaged, too large, or whose channels' names are not right; `expected`
    tells then which would be.
    """
    if not path.is_file():
        raise ImageError(f"{path}: there is no such image file")
    source = OpenImageIO.ImageInput.open(name_for_openimageio(path))
    if source is None:
        raise ImageError(
            f"{path}: expected an OpenEXR image, but it cannot be opened ({error_text(OpenImageIO.geterror)})"
        )
    try:
        names = _names_in_header(path, source)
        if not are_right(names):
            raise ImageError(f"{path}: expected {expected}, found {len(names)}: {', '.join(names)}")
        if source.seek_subimage(1, 0):
            raise ImageError(f"{path}: expected an image of one part, found several; write each to its own file")
        pixels = source.read_image("float")
        if pixels is None or source.has_error:
            raise ImageError(f"{path}: the image is damaged ({error_text(source.geterror)})")
    except UnicodeDecodeError as error:  # OpenImageIO's strings come from the file as they are
        raise ImageError(f"{path}: the image's header is damaged, a name in it is not UTF-8") from error
    finally:
        source.close()
    return np.asarray(pixels, dtype=np.float32), names


def name_for_openimageio(path: Path) -> str:
    """For OpenImageIO, which takes text only."""
    try:
        str(path).encode()
    except UnicodeEncodeError as error:
        raise ImageError(f"{path}: expected a file name in UTF-8; rename it") from error
    return str(path)


def _names_in_header(path: Path, source: OpenImageIO.ImageInput) -> tuple[str, ...]:
    """Look at the header before any pixel is read, since a damaged one may ask for all the memory there is."""
    if source.format_name() != "openexr":
        raise ImageError(f"{path}: expected an OpenEXR image with linear values, found {source.format_name()}")
    spec = source.spec()
    kinds = {str(kind) for kind in (spec.format, *spec.channelformats)}
    if spec.deep or not kinds <= {"half", "float"}:
        found = "deep pixels" if spec.deep else " and ".join(sorted(kinds))
        raise ImageError(f"{path}: expected pixels in half or float, found {found}")
    if max(spec.width, spec.height) > LARGEST_SIDE:
        raise ImageError(f"{path}: {spec.width}x{spec.height} pixels, expected at most {LARGEST_SIDE} a side")
    display = (spec.full_x, spec.full_y, spec.full_width, spec.full_height)
    if (spec.x, spec.y, spec.width, spec.height) != display:
        raise ImageError(f"{path}: expected a data window equal to the display window (an image that is not cropped)")
    return tuple(str(name) for name in spec.channelnames)


def error_text(message: object) -> str:
    """OpenImageIO's account of its last error on one line; it may quote bytes of the file that are no text."""
    try:
        return " ".join(str(message()).split()) if callable(message) else ""
    except UnicodeDecodeError:
        return "its header is damaged"
