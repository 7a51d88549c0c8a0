"""What the reference tracer tells of a scene: its image, the proven values, and the ray tree of a pixel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from raytruth.reference_tracer import certified_image, explanation, rendering
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT32, FLOAT64

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.reference_tracer.explanation_record import Explanation
    from raytruth.scenes.scene import Scene

ArithmeticName = Literal["float", "float64", "float32"]
ARITHMETICS = {"float": FLOAT, "float64": FLOAT64, "float32": FLOAT32}
# 4,096 rays a pixel: more shows no difference in 8 bits, and is a typing error rather than a wish.
MOST_SAMPLES = 64


def render(
    scene: Scene, arithmetic: ArithmeticName = "float64", samples: int = 1
) -> NDArray[np.float64] | NDArray[np.float32]:
    """The scene's image by the reference tracer: linear RGB, shape (height, width, 3), row 0 on top.

    `arithmetic` is the number type: compiled float64 or float32, which is that of the image, too, or "float" for
    interpreted Python floats, which are slow but not compiled first; their image is in float64. A pixel is the mean of
    `samples`² rays on a regular grid, 1 to 64. Images are judged by the one ray through each pixel's centre.

    Raises ValueError for another arithmetic or number of samples.
    """
    if arithmetic not in ARITHMETICS:
        raise ValueError(f"expected an arithmetic of {', '.join(ARITHMETICS)}, found {arithmetic!r}.")
    if not 1 <= samples <= MOST_SAMPLES:
        raise ValueError(f"expected 1 to {MOST_SAMPLES} samples, found {samples}.")
    image = rendering.render(scene, ARITHMETICS[arithmetic], samples=samples)
    if arithmetic == "float32":
        return image.astype(np.float32, copy=False)
    return image.astype(np.float64, copy=False)  # Python floats come as objects


def truth(
    scene: Scene, *, jobs: int = 1, fresh: bool = False, progress: Callable[[int, int], None] | None = None
) -> CertifiedImage:
    """The proven value of each pixel of the scene: `middle` ± `radius`, and the pixels that are `undecided`.

    The work is done by this process, or by `jobs` processes side by side; these import the main module anew, so a
    script that asks for more than one does so under `if __name__ == "__main__":`. What was proven before is read from
    the cache, unless `fresh`. `progress` is told how many parts of how many are done.

    Raises ValueError for fewer than one job, and BrokenProcessPool where one of several processes is ended from
    outside.
    """
    if jobs < 1:
        raise ValueError(f"expected 1 job or more, found {jobs}.")
    return certified_image.certified_image(scene, jobs=jobs, fresh=fresh, progress=progress)


def explain(scene: Scene, column: int, row: int) -> Explanation:
    """The ray tree of one pixel, term by term; `column` counts from the left, `row` from the top, both from 0.

    The sum of the contributions is, bit for bit, what `render` gives the pixel in Python floats. Raises
    ExplanationError for a pixel outside the image, one without a value, or a tree of more rays than a person reads.
    """
    return explanation.explain(scene, column, row)
