"""The truth that a scene's images are judged by, as one value a pixel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.reference_tracer.camera_rays import CENTRES
from raytruth.reference_tracer.certified_image import certified_image
from raytruth.reference_tracer.rendering import render

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.scenes.scene import Scene


def judged_truth(scene: Scene, camera_rays: CameraRays = CENTRES) -> NDArray[np.float64]:
    """The truth as images are compared with it: the middles of certified enclosures, linear RGB (height, width, 3).

    Where a pixel is undecided it is the outcome next to the value of the float64 image, if any outcome is known, and
    else that value.
    """
    image = certified_image(scene, camera_rays)
    truth = image.middle.copy()
    if image.undecided:
        rounded = np.asarray(render(scene, behaviour=camera_rays.behaviour()), dtype=np.float64)
        for (column, row), reason in image.undecided.items():
            value = rounded[row, column]
            outcomes = [outcome.middle for outcome in reason.outcomes] or [value]
            truth[row, column] = min(outcomes, key=lambda outcome: float(np.abs(value - outcome).max()))
    return truth
