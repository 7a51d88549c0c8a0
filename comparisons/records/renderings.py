"""What renderers give back: images, first hits, and what goes wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]
"""Linear RGB, shape (height, width, 3), row 0 on top."""


class RendererError(Exception):
    """A renderer crashed, hung, ran out of memory, or wrote what cannot be read; the message is one sentence."""


@dataclass(frozen=True)
class Rays:
    """Primary rays, one a pixel: arrays of shape (height, width, 3); directions are unit vectors."""

    origins: NDArray[np.float64]
    directions: NDArray[np.float64]


@dataclass(frozen=True)
class FirstHits:
    """What the primary rays meet, in arrays of shape (height, width), and (height, width, 3) for vectors."""

    depth: NDArray[np.float64]
    """Distance along the unit ray; infinity where nothing is hit."""
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    """The unit geometric normal as the shape defines it: outward, not turned to the viewer."""
    primitive: NDArray[np.int64]
    """Spheres first, then triangles, then planes, in the order of the scene's objects; -1: nothing."""


@dataclass(frozen=True)
class Rendering:
    """What one integrator gives for a scene.

    A stochastic one gives the mean over all samples, and the means of batches of them.
    """

    image: Image | None
    """None, with first hits, from an integrator that gives first hits only."""
    seconds: float
    first_hits: FirstHits | None = None
    samples: int = 1
    """How many samples each pixel has; or how many light paths the image has, where an integrator follows these."""
    batch_means: NDArray[np.float32] | None = None
    """Shape (batches, height, width, 3): means over equally many samples with independent seeds."""
