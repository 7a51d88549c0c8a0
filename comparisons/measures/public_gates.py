"""The gates of public suites: global thresholds that decide there whether a render passes.

Each is applied to a render and the truth as its suite applies it to a render and a reference. They decide nothing here:
they stand beside our own judgement, on the same faults and variants (docs/kill-matrix.md).
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from skimage.metrics import structural_similarity

from raytruth.comparisons.records.srgb import srgb_encoded

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

# The window of SSIM's mean is an odd number of pixels, and no wider than the image; 7 is scikit-image's own.
SSIM_WINDOW = 7
# Pixelmatch's: columns are Y, I and Q of the NTSC standard; their weights; and the largest that comes of two colours.
YIQ = np.array(
    [
        [0.29889531, 0.59597799, 0.21147017],
        [0.58662247, -0.27417610, -0.52261711],
        [0.11448223, -0.32180189, 0.31114694],
    ]
)
YIQ_WEIGHTS = np.array([0.5053, 0.299, 0.1957])
LARGEST_YIQ_MEASURE = 35215.0


def passes_ssim_and_psnr(render: Array, truth: Array) -> bool:
    """SSIM above 0.70 and PSNR above 20 dB of 8-bit pictures: ANARI's conformance tests (Khronos, ANARI-SDK, cts).

    As its comment means it: the code lets the second verdict overwrite the first.
    """
    a, b = as_picture(render), as_picture(truth)
    mean_square = float(((a - b) ** 2).mean())
    psnr = np.inf if mean_square == 0.0 else 20.0 * np.log10(255.0) - 10.0 * np.log10(mean_square)
    window = min(SSIM_WINDOW, (min(a.shape[:2]) - 1) // 2 * 2 + 1)
    similarity = structural_similarity(a, b, channel_axis=2, data_range=255.0, win_size=window)  # type: ignore[no-untyped-call]
    return bool(similarity > 0.70 and psnr > 20.0)


def passes_mean(render: Array, truth: Array) -> bool:
    """The mean of all pixels within 0.025 of what is expected for a scene of radiance 1: pbrt's analytic scenes."""
    expected = float(truth.mean())
    return abs(float(render.mean()) - expected) <= 0.025 * abs(expected)


def passes_decibels(render: Array, truth: Array) -> bool:
    """A root mean square of pixelmatch's measure below -22 dB of its largest: model-viewer's fidelity tests."""
    ratio = np.sqrt((_yiq_measure(render, truth) ** 2).mean()) / LARGEST_YIQ_MEASURE
    return bool(ratio <= 10.0 ** (-22.0 / 10.0))


def passes_one_percent(render: Array, truth: Array) -> bool:
    """No more than 1 % of the pixels off by more than 0.016 in a channel: render tests of Blender's Cycles (idiff)."""
    off = np.abs(as_picture(render) - as_picture(truth)).max(axis=2) > 0.016 * 255.0
    return float(off.mean()) <= 0.01


def passes_eight_components(render: Array, truth: Array) -> bool:
    """No more than 8 components off by more than 2 of 255: appleseed's runtestsuites.py."""
    off = np.abs(as_picture(render) - as_picture(truth)) > 2.0
    return int(off.sum()) <= 8


def passes_pixelmatch(render: Array, truth: Array) -> bool:
    """No more than 5 % of the pixels off by more than pixelmatch's threshold 0.2: three.js's end-to-end tests.

    Without pixelmatch's detection of anti-aliased pixels: these images have none.
    """
    off = _yiq_measure(render, truth) > LARGEST_YIQ_MEASURE * 0.2 * 0.2
    return float(off.mean()) <= 0.05


def _yiq_measure(render: Array, truth: Array) -> Array:
    """Pixelmatch's squared difference of each pixel's colour (Kotsarenko, Ramos, "Measuring Perceived Color Difference
    using YIQ NTSC Transmission Color Space in Mobile Applications", 2010).
    """
    yiq = (as_picture(render) - as_picture(truth)) @ YIQ
    measure: Array = (yiq * yiq) @ YIQ_WEIGHTS
    return measure


GATES: dict[str, Callable[[Array, Array], bool]] = {
    "SSIM > 0.70 and PSNR > 20 dB": passes_ssim_and_psnr,
    "mean ±2.5 %": passes_mean,
    "-22 dB": passes_decibels,
    "0.016 on 1 % of pixels": passes_one_percent,
    "8 components over 2/255": passes_eight_components,
    "pixelmatch 0.2 on 5 % of pixels": passes_pixelmatch,
}
"""Each gate by what it asks for."""


def gates_that_reject(render: Array, truth: Array) -> tuple[str, ...]:
    """The gates that a linear image of shape (height, width, 3) does not pass against the truth; NaN passes none."""
    if not np.isfinite(render).all():
        return tuple(GATES)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # SSIM of constant pictures
        return tuple(name for name, passes in GATES.items() if not passes(render, truth))


def as_picture(linear: Array) -> Array:
    """What such a suite would compare: 8-bit codes of sRGB, as floats."""
    return np.asarray(np.rint(srgb_encoded(np.clip(linear, 0.0, 1.0)) * 255.0), np.float64)
