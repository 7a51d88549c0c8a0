from __future__ import annotations

import pytest

from raytruth.reference_tracer.source import features
from raytruth.scenes.features import Feature

pytestmark = pytest.mark.clause("SCN-6")


def names() -> dict[str, bool]:
    return {name: value for name, value in vars(features).items() if name.isupper()}


def test_the_source_knows_the_features_that_scenes_require_and_no_others() -> None:
    assert set(names()) == {feature.value for feature in Feature}


def test_everything_is_on_in_the_plain_source() -> None:
    assert all(value is True for value in names().values())
