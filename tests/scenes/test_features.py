from __future__ import annotations

import pytest

from raytruth.scenes.features import Feature, missing_features

pytestmark = pytest.mark.clause("REN-3")


def test_a_program_that_has_all_that_is_required_lacks_nothing() -> None:
    assert missing_features("x", {Feature.SPHERES, Feature.MIRRORS}, {Feature.MIRRORS}) is None


def test_what_is_missing_is_named_in_words_in_one_clause() -> None:
    required = {Feature.SPHERES, Feature.POINT_LIGHTS, Feature.CONSTANT_SPLIT}
    clause = missing_features("x", {Feature.SPHERES}, required)
    assert clause == "x is not known to have what the scene requires: constant split, point lights"
