from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.records.image_files import write_image
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene
from tests.raytruth.running import refusal, run
from tests.reports.sample_results import noise, sphere_image

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-4")


@pytest.fixture
def image(tmp_path: Path) -> Path:
    path = tmp_path / "one.exr"
    write_image(path, sphere_image())
    return path


def test_two_images_make_a_page(image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "both.html"
    assert run(capsys, "compare", str(image), str(image), "--out", str(out)) == (0, f"Comparison: {out}\n", "")
    assert "4096 of 4096 pixels are the same, bit by bit" in out.read_text(encoding="utf-8")


def test_with_a_scene_both_are_judged(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    right = render(open_scene("single-sphere")).astype(np.float32)
    paths = [tmp_path / "right.exr", tmp_path / "wrong.exr"]
    for path, factor in zip(paths, (1, 2), strict=True):
        write_image(path, right * np.float32(factor))
    out = tmp_path / "comparison"
    status, told, _ = run(capsys, "compare", *map(str, paths), "--scene", "single-sphere", "--out", str(out))
    assert status == 1
    assert [line.split()[0] for line in told.splitlines() if ".exr:" in line] == ["pass", "fail"]
    assert len(list((out / "report" / "cells").iterdir())) == 2


def test_images_that_cannot_be_compared_get_one_sentence(
    image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    small, grey, broken = (tmp_path / f"{name}.exr" for name in ("small", "grey", "broken"))
    write_image(small, sphere_image()[:-1].copy())
    write_image(grey, noise())
    broken.write_bytes(b"nothing")
    for other, expected in [
        (small, "expected two images of one size, found 64×64 and 64×63 pixels"),
        (grey, "expected an image with R, G and B"),
        (broken, "expected an OpenEXR image"),
        (tmp_path / "nowhere.exr", "there is no such image file"),
    ]:
        assert expected in refusal(capsys, "compare", str(image), str(other), "--out", str(tmp_path / "x.html"))
    assert "is a folder" in refusal(capsys, "compare", str(image), str(image), "--out", str(tmp_path))
    assert not (tmp_path / "x.html").exists()
