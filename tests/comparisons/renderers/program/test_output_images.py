from __future__ import annotations

import os
import re
import struct
from typing import TYPE_CHECKING, Any

import numpy as np
import OpenImageIO
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.records.image_files import ImageError
from raytruth.comparisons.records.srgb import srgb_decoded
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from raytruth.comparisons.renderers.program.declared_model import output_model_of
from raytruth.comparisons.renderers.program.output_images import read_output, stored_numbers

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.records.renderings import Image
    from raytruth.comparisons.renderers.program.declaration import Declaration

pytestmark = pytest.mark.clause("REN-9")

WIDTH, HEIGHT = 4, 3
# Each pixel and each channel another number, which all formats hold.
CODES = np.arange(HEIGHT * WIDTH * 3).reshape(HEIGHT, WIDTH, 3)


def declared(**keys: Any) -> Declaration:
    return checked_declaration({"name": "mine", "command": ["a", "{scene}", "{output}"], **keys}, "mine.toml")


def read(path: Path, **keys: Any) -> Image:
    declaration = declared(**keys)
    return read_output(path, declaration, (HEIGHT, WIDTH), output_model_of(declaration))


def refusal(path: Path, **keys: Any) -> str:
    with pytest.raises(ImageError) as raised:
        read(path, **keys)
    assert "\n" not in str(raised.value)
    return str(raised.value)


def pfm(pixels: NDArray[Any], *, endian: str = "<", scale: float = 1.0) -> bytes:
    """By Debevec's description: the lowest row first, and a scale whose sign is the order of bytes."""
    height, width, _ = pixels.shape
    sign = -scale if endian == "<" else scale
    return b"PF\n%d %d\n%.1f\n" % (width, height, sign) + pixels[::-1].astype(f"{endian}f4").tobytes()


def saved(path: Path, pixels: NDArray[Any], kind: str, names: tuple[str, ...] = ("R", "G", "B")) -> Path:
    spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
    spec.channelnames = names
    spec.attribute("oiio:UnassociatedAlpha", 1)
    buffer = OpenImageIO.ImageBuf(spec)
    buffer.set_pixels(OpenImageIO.ROI.All, pixels)
    assert buffer.write(str(path))
    return path


@pytest.mark.parametrize("endian", ["<", ">"])
def test_a_pfm_begins_with_its_lowest_row_in_either_order_of_bytes(endian: str, tmp_path: Path) -> None:
    path = tmp_path / "output.pfm"
    path.write_bytes(pfm(CODES, endian=endian))
    np.testing.assert_array_equal(read(path, writes="pfm"), CODES)


@pytest.mark.parametrize(("largest", "kind", "numbers"), [(255, ">u1", "uint8"), (65535, ">u2", "uint16")])
@pytest.mark.parametrize("magic", [b"P6", b"P3"])
def test_a_ppm_is_read_by_its_codes(largest: int, kind: str, numbers: str, magic: bytes, tmp_path: Path) -> None:
    path = tmp_path / "output.ppm"
    body = CODES.astype(kind).tobytes() if magic == b"P6" else " ".join(map(str, CODES.ravel())).encode()
    path.write_bytes(b"%b\n%d %d\n%d\n%b\n" % (magic, WIDTH, HEIGHT, largest, body))
    np.testing.assert_array_equal(read(path, writes="ppm", numbers=numbers), (CODES / largest).astype(np.float32))


@pytest.mark.parametrize(("kind", "largest"), [("uint8", 255), ("uint16", 65535)])
def test_a_png_is_read_by_its_codes_which_may_be_encoded(kind: Any, largest: int, tmp_path: Path) -> None:
    path = saved(tmp_path / "output.png", CODES.astype(kind), kind)
    assert stored_numbers(path) == kind
    np.testing.assert_array_equal(read(path, writes="png", numbers=kind), (CODES / largest).astype(np.float32))
    expected = srgb_decoded(CODES / largest).astype(np.float32)
    np.testing.assert_array_equal(read(path, writes="png", numbers=kind, colours="srgb"), expected)


def test_alpha_and_other_channels_do_not_matter(tmp_path: Path) -> None:
    with_alpha = np.concatenate([CODES, np.full((HEIGHT, WIDTH, 1), 7)], axis=2)
    path = saved(tmp_path / "output.png", with_alpha.astype(np.uint8), "uint8", ("R", "G", "B", "A"))
    np.testing.assert_array_equal(read(path, writes="png"), (CODES / 255).astype(np.float32))
    path = saved(tmp_path / "output.exr", with_alpha.astype(np.float32), "float", ("G", "B", "R", "Z"))
    np.testing.assert_array_equal(read(path), CODES[..., [2, 0, 1]])


@pytest.mark.parametrize("kind", ["half", "float"])
def test_an_exr_holds_the_numbers_that_are_declared(kind: Any, tmp_path: Path) -> None:
    path = saved(tmp_path / "output.exr", CODES.astype(np.float32), kind)
    np.testing.assert_array_equal(read(path, numbers=kind), CODES)
    other = "float" if kind == "half" else "half"
    assert (
        refusal(path, numbers=other) == f"its output.exr holds {kind} numbers, but {other} is declared; declare {kind}"
    )


def test_a_radiance_picture_is_read(tmp_path: Path) -> None:
    path = tmp_path / "output.hdr"
    # Ward's header; 128 is the mantissa of a half, and the exponent 128 + e belongs to 2^e.
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n"
    path.write_bytes(head + bytes([128, 64, 0, 129]) * (WIDTH * HEIGHT))
    np.testing.assert_array_equal(read(path, writes="hdr"), np.broadcast_to([1.0, 0.5, 0.0], (HEIGHT, WIDTH, 3)))
    path.write_bytes(head.replace(b"-Y", b"+Y") + bytes([128, 64, 0, 129]) * (WIDTH * HEIGHT))
    assert "another orientation" in refusal(path, writes="hdr")


def test_flips_are_undone(tmp_path: Path) -> None:
    path = tmp_path / "output.pfm"
    path.write_bytes(pfm(CODES))
    flipped = read(path, writes="pfm", conventions={"flip_x": True})
    np.testing.assert_array_equal(flipped, CODES[:, ::-1])
    np.testing.assert_array_equal(read(path, writes="pfm", conventions={"flip_y": True}), CODES[::-1])


def test_what_is_not_as_declared_is_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "output.pfm"
    assert refusal(path, writes="pfm") == "it wrote no output.pfm"
    path.write_bytes(pfm(CODES[:, :2]))
    assert refusal(path, writes="pfm") == "its output.pfm has 2x3 pixels, expected 4x3 pixels"
    assert refusal(path, writes="png") == "its output.pfm is pnm, but png is declared"
    path.write_bytes(pfm(CODES)[:-4])
    assert refusal(path, writes="pfm").startswith("its output.pfm is damaged or incomplete (")
    path.write_bytes(b"P6\n4 3\n100\n" + bytes(36))
    assert "7 bits a number" in refusal(path, writes="ppm")
    grey = saved(tmp_path / "grey.png", CODES[..., :1].astype(np.uint8), "uint8", ("Y",))
    assert refusal(grey, writes="png") == "its grey.png has the channels Y, expected R, G and B"


def test_what_is_no_regular_file_is_not_opened(tmp_path: Path) -> None:
    pipe, link, picture = (tmp_path / name for name in ("pipe.pfm", "link.pfm", "picture.pfm"))
    os.mkfifo(pipe)
    picture.write_bytes(pfm(CODES))
    link.symlink_to(picture)
    for path in (pipe, link, tmp_path):
        assert re.fullmatch(r"its .* is no regular file", refusal(path, writes="pfm"))


BEGINNINGS = [
    b"",
    b"PF\n4 3\n-1.0\n",
    b"PF\n99999999 99999999\n-1\n",
    b"P6\n4 3\n255\n",
    b"P3 4 3 255 ",
    b"\x89PNG\r\n\x1a\n",
    b"#?RADIANCE\n\n-Y 3 +X 4\n",
    struct.pack("<I", 20000630) + b"\2\0\0\0",
]


@given(beginning=st.sampled_from(BEGINNINGS), rest=st.binary(max_size=60))
@pytest.mark.parametrize("form", ["pfm", "ppm", "png", "hdr", "exr"])
def test_any_bytes_give_a_picture_or_a_sentence(
    form: str, beginning: bytes, rest: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / f"any.{form}"
    path.write_bytes(beginning + rest)
    told, shape = "", (HEIGHT, WIDTH, 3)
    try:
        shape = read(path, writes=form).shape
    except ImageError as error:
        told = str(error)
    assert "\n" not in told
    assert shape == (HEIGHT, WIDTH, 3)
