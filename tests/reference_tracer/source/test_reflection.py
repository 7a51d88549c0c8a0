from __future__ import annotations

import pytest

from raytruth.reference_tracer.source.reflection import mirror_direction

pytestmark = pytest.mark.clause("REFL-1")


@pytest.mark.parametrize(
    ("direction", "mirrored"),
    [
        ((0.0, 0.0, -1.0), (0.0, 0.0, 1.0)),
        ((1.0, 2.0, -3.0), (1.0, 2.0, 3.0)),
        ((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),  # grazing: not turned
    ],
)
def test_the_part_along_the_normal_turns_round(
    direction: tuple[float, float, float], mirrored: tuple[float, float, float]
) -> None:
    assert mirror_direction(direction, (0.0, 0.0, 1.0)) == mirrored
    assert mirror_direction(direction, (0.0, 0.0, -1.0)) == mirrored
