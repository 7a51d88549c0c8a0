"""OpenEXR holds more than floating-point images; what would be read otherwise than it is meant is refused."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
import pytest

from raytruth.comparisons.records.image_files import ImageError, read_image, write_image

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

pytestmark = pytest.mark.clause("RES-2")

PIXELS = np.linspace(0, 1, 36, dtype=np.float32).reshape(3, 4, 3)


@pytest.mark.parametrize("channels", [[b"B"], [b"G"], [b"R", b"G", b"B"]])
def test_an_image_with_whole_numbers_is_refused(channels: Sequence[bytes], tmp_path: Path) -> None:
    path = tmp_path / "whole.exr"
    write_image(path, PIXELS)
    content = bytearray(path.read_bytes())
    for channel in channels:  # its entry in the list of channels: name and kind, 2 for float and 0 for whole numbers
        kind = content.index(channel + b"\0\2\0\0\0", content.index(b"channels\0chlist\0")) + 2
        content[kind] = 0
    path.write_bytes(content)
    with pytest.raises(ImageError, match=r"expected pixels in half or float, found .*uint"):
        read_image(path)


def test_an_image_in_half_is_read(tmp_path: Path) -> None:
    path = tmp_path / "half.exr"
    output = OpenImageIO.ImageOutput.create(str(path))
    assert output.open(str(path), OpenImageIO.ImageSpec(4, 3, 3, "half"))
    output.write_image(PIXELS)
    output.close()
    assert (read_image(path) == PIXELS.astype(np.float16)).all()


def test_an_image_of_several_parts_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "parts.exr"
    specs = [OpenImageIO.ImageSpec(4, 3, 3, "float") for _ in range(2)]
    for number, spec in enumerate(specs):
        spec.attribute("oiio:subimagename", f"part {number}")
    output = OpenImageIO.ImageOutput.create(str(path))
    assert output.open(str(path), tuple(specs))
    output.write_image(PIXELS)
    assert output.open(str(path), specs[1], "AppendSubimage")
    output.write_image(PIXELS)
    output.close()
    with pytest.raises(ImageError, match="of one part, found several"):
        read_image(path)


def test_a_name_that_is_no_text_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / os.fsdecode(b"\xff")
    folder.mkdir()
    path = folder / "image.exr"
    with pytest.raises(ImageError, match="a file name in UTF-8"):
        write_image(path, PIXELS)
    path.touch()
    with pytest.raises(ImageError, match="a file name in UTF-8"):
        read_image(path)


def test_the_same_pixels_are_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    contents = []
    for zone in ("UTC-3", "UTC+9"):  # another hour, without waiting
        monkeypatch.setenv("TZ", zone)
        write_image(tmp_path / "image.exr", PIXELS)
        contents.append((tmp_path / "image.exr").read_bytes())
    assert contents[0] == contents[1]
    assert b"1970:01:01 00:00:00" in contents[0]
