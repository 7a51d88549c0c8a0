from __future__ import annotations

import numpy as np
import pytest

from raytruth.comparisons.noise.pixel_blocks import block_sizes, block_sums, spread

pytestmark = pytest.mark.clause("VER-6")


def test_blocks_double_until_one_holds_the_whole_image() -> None:
    assert block_sizes(1, 1) == [1]
    assert block_sizes(4, 3) == [1, 2, 4]
    assert block_sizes(2, 5) == [1, 2, 4, 8]


def test_sums_of_blocks_are_spread_to_their_own_pixels() -> None:
    image = np.arange(15.0).reshape(3, 5, 1)
    sums = block_sums(image, 2)
    assert sums[..., 0].tolist() == [[0 + 1 + 5 + 6, 2 + 3 + 7 + 8, 4 + 9], [10 + 11, 12 + 13, 14]]
    shown = spread(sums, 2, image.shape)
    assert shown.shape == image.shape
    for row, column in np.ndindex(3, 5):
        assert shown[row, column, 0] == sums[row // 2, column // 2, 0]
