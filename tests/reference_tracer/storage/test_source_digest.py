from __future__ import annotations

import pytest

from raytruth.reference_tracer.storage.source_digest import source_digest

pytestmark = pytest.mark.clause("ARI-6")


def test_a_digest_is_the_same_again_and_another_for_other_packages() -> None:
    assert source_digest("scenes") == source_digest.__wrapped__("scenes")
    assert len({source_digest("scenes"), source_digest("scenes", "reference_tracer"), source_digest("no such")}) == 3


def test_a_folder_may_be_left_out() -> None:
    assert source_digest("scenes", without=("scenes/exporters",)) != source_digest("scenes")
    assert source_digest("scenes", without=("scenes/exp",)) == source_digest("scenes")
