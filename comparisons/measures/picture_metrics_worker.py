"""A child process that measures how different two pictures look; its only arguments are pair numbers.

In its folder lie `NUMBER-render.npy` and `NUMBER-truth.npy`, linear float32. One JSON line for each measure goes to
`measured.jsonl` at once, so that whatever ends this process costs one pair's measure and no other.
"""

from __future__ import annotations

import faulthandler
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import flip_evaluator
import numpy as np
import skimage.color
import skimage.metrics

from raytruth.comparisons.records.srgb import srgb_encoded

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Picture = NDArray[np.float64]

# These have no types of their own.
structural_similarity: Callable[..., Any] = skimage.metrics.structural_similarity
rgb_to_lab: Callable[..., Any] = skimage.color.rgb2lab
delta_e_2000: Callable[..., Any] = skimage.color.deltaE_ciede2000

# FLIP needs 2.4 µs a pixel here; a hundred times that, and a minute for a machine that is busy, is a hang.
SECONDS_A_PIXEL = 2.4e-4
SECONDS_TO_SPARE = 60
# Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment", sec. III-B: an 11x11 Gaussian window of 1.5 pixels.
SSIM_WINDOW = 11
SSIM_SIGMA = 1.5


def main(numbers: list[str]) -> None:
    """Measure the pairs of these numbers in the current folder."""
    with Path("measured.jsonl").open("a", encoding="utf-8") as file:
        for number in numbers:
            render, truth = (srgb_encoded(displayable(f"{number}-{which}.npy")) for which in ("render", "truth"))
            look = {"ssim": ssim(render, truth), "delta_e_2000": largest_delta_e(render, truth)}
            print(json.dumps({"pair": int(number)} | look), file=file, flush=True)
            # A thread without Python ends the process even while FLIP's own code hangs.
            faulthandler.dump_traceback_later(SECONDS_TO_SPARE + SECONDS_A_PIXEL * render[..., 0].size, exit=True)
            print(json.dumps({"pair": int(number), "flip": flip(render, truth)}), file=file, flush=True)
            faulthandler.cancel_dump_traceback_later()


def displayable(file: str) -> Picture:
    """Linear values in [0, 1]: what is brighter than white is shown as white."""
    linear: Picture = np.load(file).astype(np.float64)
    return np.asarray(linear.clip(0.0, 1.0))


def ssim(render: Picture, truth: Picture) -> float | None:
    """The mean structural similarity of sRGB pictures; None if they are smaller than its window."""
    if min(truth.shape[:2]) < SSIM_WINDOW:
        return None
    similarity = structural_similarity(
        truth,
        render,
        channel_axis=2,
        data_range=1.0,
        gaussian_weights=True,
        sigma=SSIM_SIGMA,
        use_sample_covariance=False,
    )
    return float(similarity)


def largest_delta_e(render: Picture, truth: Picture) -> float:
    """The largest CIE ΔE2000 of a pixel of sRGB pictures, under D65."""
    return float(np.max(delta_e_2000(rgb_to_lab(truth), rgb_to_lab(render))))


def flip(render: Picture, truth: Picture) -> float:
    """The mean of LDR-FLIP (Andersson et al. 2020) of sRGB pictures, at the distance that it takes by default."""
    pictures = [np.ascontiguousarray(picture, dtype=np.float32) for picture in (truth, render)]
    _, mean, _ = flip_evaluator.evaluate(*pictures, "LDR", applyMagma=False)
    return float(mean)


if __name__ == "__main__":
    main(sys.argv[1:])
