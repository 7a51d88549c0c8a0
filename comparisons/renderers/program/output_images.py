"""Reads the pictures that programs write, in the formats that they may declare; whatever is in a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import OpenImageIO

from raytruth.comparisons.records.image_files import ImageError, error_text, name_for_openimageio

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.renderers.program.declaration import Declaration

Format = Literal["exr", "pfm", "hdr", "ppm", "png"]
Numbers = Literal["uint8", "uint16", "half", "float"]
NUMBERS: tuple[Numbers, ...] = get_args(Numbers)
ModelNumbers = Literal["uint8", "uint16", "float16", "float32", "rgbe"]

FORMATS: dict[Format, tuple[str, dict[Numbers, ModelNumbers]]] = {
    "exr": ("openexr", {"float": "float32", "half": "float16"}),
    "pfm": ("pnm", {"float": "float32"}),
    "hdr": ("hdr", {"float": "rgbe"}),
    "ppm": ("pnm", {"uint8": "uint8", "uint16": "uint16"}),
    "png": ("png", {"uint8": "uint8", "uint16": "uint16"}),
}
"""What OpenImageIO calls each format, and what its numbers are in an error model, the usual ones first."""

_MANY = 64
"""More channels than any picture has; their names would fill a sentence."""


def numbers_of(form: Format, stated: Numbers | None) -> ModelNumbers:
    """The numbers of an error model for a format, and for the numbers that are stated of it, if they are."""
    return FORMATS[form][1][stated or usual_numbers(form)]


def usual_numbers(form: Format) -> Numbers:
    """The numbers that a picture of a format holds unless others are declared."""
    return next(iter(FORMATS[form][1]))


def stored_numbers(path: Path) -> Numbers:
    """Which numbers a file holds, by its header. Raises ImageError for what is no picture of a known format."""
    source = _opened(path)
    try:
        return _checked_numbers(path, source.spec())
    finally:
        source.close()


def read_output(path: Path, declared: Declaration, size: tuple[int, int], model: OutputModel) -> Image:
    """The linear colours in a picture of a size, (height, width), which must be as declared; flips are undone.

    Only R, G and B are read. Raises ImageError, in one sentence, for a file that is missing, damaged, of another
    format or size, or that holds other numbers.
    """
    source = _opened(path)
    try:
        spec = source.spec()
        if source.format_name() != FORMATS[declared.writes][0]:
            raise ImageError(f"its {path.name} is {source.format_name()}, but {declared.writes} is declared")
        numbers = declared.numbers or usual_numbers(declared.writes)
        found = _checked_numbers(path, spec)
        if found != numbers:
            raise ImageError(f"its {path.name} holds {found} numbers, but {numbers} is declared; declare {found}")
        if (spec.height, spec.width) != size:
            expected = f"{size[1]}x{size[0]} pixels"
            raise ImageError(f"its {path.name} has {spec.width}x{spec.height} pixels, expected {expected}")
        channels = _colour_channels(path, spec)
        pixels = source.read_image("float" if found == "half" else found)
        if pixels is None or source.has_error:
            raise ImageError(f"its {path.name} is damaged or incomplete ({error_text(source.geterror)})")
    except UnicodeDecodeError as error:  # OpenImageIO's strings come from the file as they are
        raise ImageError(f"the header of its {path.name} is damaged, a name in it is not UTF-8") from error
    finally:
        source.close()
    return declared.conventions.undone(_linear(np.asarray(pixels)[..., channels], model))


def _linear(pixels: NDArray[np.generic], model: OutputModel) -> Image:
    with np.errstate(over="ignore", invalid="ignore"):  # of what is infinite or no number, which is told elsewhere
        return model.linear_values(pixels).astype(np.float32)


def _opened(path: Path) -> OpenImageIO.ImageInput:
    """The file as OpenImageIO opens it. A pipe or a device would have us wait for ever, and a link show other files."""
    if not path.exists():
        raise ImageError(f"it wrote no {path.name}")
    if path.is_symlink() or not path.is_file():
        raise ImageError(f"its {path.name} is no regular file")
    hints = OpenImageIO.ImageSpec()
    hints.attribute("pnm:pfmflip", 1)  # a PFM begins with its lowest row
    hints.attribute("oiio:UnassociatedAlpha", 1)  # colours as they are in the file
    source = OpenImageIO.ImageInput.open(name_for_openimageio(path), hints)
    if source is None:
        raise ImageError(f"its {path.name} is no picture that can be read ({error_text(OpenImageIO.geterror)})")
    return source


def _checked_numbers(path: Path, spec: OpenImageIO.ImageSpec) -> Numbers:
    """Which numbers the file holds; looked at before any pixel is read."""
    kinds = {str(kind) for kind in (spec.channelformats or (spec.format,))}
    if spec.deep or len(kinds) != 1 or not kinds <= set(NUMBERS):
        found = "deep pixels" if spec.deep else " and ".join(sorted(kinds))
        raise ImageError(f"its {path.name} holds {found}, expected uint8, uint16, half or float in all channels")
    bits = spec.getattribute("oiio:BitsPerSample")
    if bits not in {None, 8, 16, 32}:
        raise ImageError(f"its {path.name} has {bits} bits a number, expected 8 or 16 (of PPM a maximum of 255)")
    display = (spec.full_x, spec.full_y, spec.full_width, spec.full_height)
    if (spec.x, spec.y, spec.width, spec.height) != display:
        raise ImageError(f"its {path.name} is cropped: its data window is not its display window")
    if spec.getattribute("Orientation") not in {None, 1}:
        raise ImageError(f"its {path.name} has another orientation than row by row from the top left")
    return next(known for known in NUMBERS if known in kinds)


def _colour_channels(path: Path, spec: OpenImageIO.ImageSpec) -> list[int]:
    """The numbers of the channels R, G and B."""
    names = [str(name) for name in spec.channelnames]
    if len(names) > _MANY or not {"R", "G", "B"} <= set(names):
        told = ", ".join(names) if len(names) <= _MANY else str(len(names))
        raise ImageError(f"its {path.name} has the channels {told}, expected R, G and B")
    return [names.index(name) for name in ("R", "G", "B")]
