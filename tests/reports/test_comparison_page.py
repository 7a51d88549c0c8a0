from __future__ import annotations

import re

import numpy as np
import pytest

from raytruth.reports.comparison_page import comparison_page
from tests.reports.sample_results import HOSTILE, sphere_image

pytestmark = pytest.mark.clause("REP-3")


def test_two_images_are_counted_and_shown_with_their_difference() -> None:
    first = sphere_image()
    second = first.copy()
    second[3, 4, 1] += np.float32(0.25)
    page = comparison_page(("a.exr", "b.exr"), (first, second))
    assert "4095 of 4096 pixels are the same, bit by bit; the largest difference is 0.25." in page
    assert '"worst":[4,3]' in page
    assert page.count("<img") == 3


@pytest.mark.clause("REP-2")
def test_hostile_names_and_images_without_a_number_are_inert() -> None:
    strange = np.full_like(sphere_image(), np.nan)
    page = comparison_page((HOSTILE, HOSTILE), (strange, strange))
    assert HOSTILE not in page
    assert len(re.findall(r"<script>", page)) == 1
