"""Global measures of difference between a render and the truth: reported, never the gate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO

from raytruth.comparisons.measures.picture_metrics import picture_metrics
from raytruth.comparisons.records.results import Metrics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.records.renderings import Image

# Keeps dark pixels from dominating: a tenth of white, squared, as the image viewer tev has it.
RELATIVE_MSE_EPSILON = 0.01


def compute_metrics(render: Image, truth: Image) -> Metrics:
    """The measures of one pair; see `compute_metrics_batch`, which is quicker for many."""
    return compute_metrics_batch([(render, truth)])[0]


def compute_metrics_batch(pairs: Sequence[tuple[NDArray[np.floating], NDArray[np.floating]]]) -> list[Metrics]:
    """The measures of pairs of a render and the truth: linear RGB of one shape (height, width, 3) each.

    A pair with a value that is not finite in float32 has no measures; a measure without a value for a pair is None.
    Raises ValueError for images of another or of different shapes.
    """
    for render, truth in pairs:
        if render.shape != truth.shape or render.ndim != 3 or render.shape[-1] != 3 or render.size == 0:
            raise ValueError(f"expected two images of one shape (h, w, 3), got {render.shape} and {truth.shape}")
    with np.errstate(over="ignore"):  # becomes infinite, which is looked for
        as_float32 = [(render.astype(np.float32), truth.astype(np.float32)) for render, truth in pairs]
    finite = [bool(np.isfinite(render).all() and np.isfinite(truth).all()) for render, truth in as_float32]
    comparable = [pair for pair, is_finite in zip(as_float32, finite, strict=True) if is_finite]
    pictures = iter(picture_metrics(comparable))
    return [
        Metrics(**_numeric_metrics(*pair), **next(pictures)) if is_finite else Metrics()
        for pair, is_finite in zip(as_float32, finite, strict=True)
    ]


def _numeric_metrics(render: Image, truth: Image) -> dict[str, float | None]:
    compared = OpenImageIO.ImageBufAlgo.compare(OpenImageIO.ImageBuf(render), OpenImageIO.ImageBuf(truth), 0.0, 0.0)
    difference = render.astype(np.float64) - truth
    return {
        "largest_difference": compared.maxerror,
        "mean_difference": float(difference.mean()),
        "rmse": compared.rms_error,
        "relative_mse": _relative_mse(difference, truth),
        "psnr": _psnr(compared.rms_error, float(np.max(truth))),
    }


def _relative_mse(difference: NDArray[np.float64], truth: Image) -> float:
    """The mean of (x − r)² / (r² + ε) over pixels and channels (Rousselle, Knaus, Zwicker 2011, "Adaptive Sampling and
    Reconstruction using Greedy Error Minimization").
    """
    return float(np.mean(difference**2 / (truth.astype(np.float64) ** 2 + RELATIVE_MSE_EPSILON)))


def _psnr(rmse: float, peak: float) -> float | None:
    """20·log10(peak / RMSE) in decibels; None for identical images and for a black truth.

    OpenImageIO's own takes the larger of 1 and both images' largest value for the peak, so that a firefly improves it.
    """
    if rmse == 0 or peak <= 0:
        return None
    return 20 * math.log10(peak / rmse)
