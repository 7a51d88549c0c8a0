"""The verdict on an image of anyone's: does every pixel lie in its feasible set?"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.judgement.kept_expectation import kept_expectation
from raytruth.comparisons.judgement.pixel_verdict import with_shortcuts
from raytruth.comparisons.judgement.verdict import judge_exact
from raytruth.comparisons.renderers.program.declaration_file import load_declaration
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.comparisons.records.results import DeclaredPixels, Verdict, WorstPixel
    from raytruth.comparisons.renderers.program.declaration import Declaration
    from raytruth.scenes.scene import Scene

FLOATS = ("float16", "float32", "float64")


@dataclass(frozen=True, eq=False)
class ImageJudgement:
    """What `judge` finds of an image."""

    verdict: Verdict
    """"pass" if every judged pixel lies in its feasible set, looks as it is due, and nearly all could be judged;
    "declared" where only a declared shortcut explains how some look; "fail" if one lies outside; "incomparable" where
    more than one in a hundred could not be judged."""
    reason: str
    """The verdict in words, with its counts."""
    pixels: int
    """How many the image has."""
    failing: int
    """How many lie outside their feasible sets."""
    unjudged: int
    """How many pixels there are of which the error model leaves everything open."""
    capped: int
    """How many have more outcomes than are told apart, so that one box holds several."""
    ambiguous: int
    """How many have more than one outcome, as on edges and at the rims of shadows."""
    declared: DeclaredPixels | None
    """Those that are as declared, not as due: how many, which, and how far from the truth; None if there are none."""
    worst: WorstPixel
    """The one with the largest distance, whether it fails or not."""
    distances: NDArray[np.float64]
    """Each pixel's distance from the middle of its nearest outcome, in tolerances; shape (height, width).

    Up to 1 the pixel is feasible; infinity where there is no tolerance at all; -1 where the pixel is not judged.
    """


def feasible_set(scene: Scene, error_model: ErrorModel) -> FeasibleSet:
    """All that a renderer with this error model may give each pixel of the scene; kept in the cache."""
    return kept_feasible_set(scene, error_model)


def judge(image: NDArray[np.floating[Any]], scene: Scene, error_model: ErrorModel | str | Path) -> ImageJudgement:
    """The verdict on an image that was rendered without random numbers, as the matrix gives it.

    The image is linear RGB of the scene's size, shape (height, width, 3), row 0 on top, in float16, float32 or float64.
    Its values are judged as they are given: where a file holds integers, they are the linear values that
    `error_model.output.linear_values` reads from these. The truth and the feasible set are kept in the cache.

    In place of an error model stands the path of a TOML file that declares a program (docs/your-renderer.md): then the
    image is as the program gives it, and what the file says is flipped is turned before it is judged.

    Raises ValueError for another shape or type of numbers, for an image that holds NaN, and for a program that draws
    random samples; DeclarationError for a file that declares no program.
    """
    _check(image, scene)
    if not isinstance(error_model, ErrorModel):
        declared = _of_one_picture(Path(error_model))
        image = declared.conventions.undone(image)
        error_model = error_model_of_declaration(declared).in_scene(scene)
    values: Any = image.astype(np.float64)  # holds every number of the narrower types
    expectation = kept_expectation(scene, error_model)
    judged = judge_exact(values, expectation)
    verdict, reason = with_shortcuts(judged.verdict, judged.reason, expectation.shortcuts)
    counts = judged.judgement
    assert counts.worst is not None, "an image has a pixel"
    return ImageJudgement(
        verdict=verdict,
        reason=reason,
        pixels=counts.pixels,
        failing=counts.failing,
        unjudged=counts.unjudged,
        capped=counts.capped,
        ambiguous=counts.ambiguous,
        declared=counts.declared,
        worst=counts.worst,
        distances=judged.distances.max(axis=2),
    )


def _of_one_picture(path: Path) -> Declaration:
    """What a file declares of a program whose one picture can be judged."""
    declared = load_declaration(path)
    if declared.sampling.samples:
        raise ValueError(f"{path}: sampling: one image of random samples cannot be judged; use raytruth run.")
    return declared


def _check(image: NDArray[Any], scene: Scene) -> None:
    if not isinstance(image, np.ndarray):
        raise ValueError(f"expected an image as a NumPy array, found {type(image).__name__}.")
    if image.dtype.name not in FLOATS:
        raise ValueError(f"expected an image of {', '.join(FLOATS)}, found {image.dtype.name}.")
    expected = (scene.camera.height, scene.camera.width, 3)
    if image.shape != expected:
        raise ValueError(f"expected an image of shape {expected} (height, width, RGB), found {image.shape}.")
    is_nan = np.isnan(image).any(axis=2)
    if is_nan.any():
        row, column = np.argwhere(is_nan)[0]
        raise ValueError(
            f"expected numbers in an image, found {is_nan.sum()} pixels that hold NaN, "
            f"the first of them at column {column}, row {row}."
        )
