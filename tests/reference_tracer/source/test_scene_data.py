from __future__ import annotations

import pytest

from raytruth.reference_tracer.source import scene_data as layout
from tests.reference_tracer.kernels import scene_data

pytestmark = pytest.mark.clause("ARI-1")

NOT_TABLES = {"NUMBER_OF_TABLES", "TYPE_CHECKING"}
TABLES = [value for name, value in vars(layout).items() if name.isupper() and name not in NOT_TABLES]


def test_tables_are_numbered_without_gaps() -> None:
    assert sorted(TABLES) == list(range(layout.NUMBER_OF_TABLES))


def test_rows_are_read_where_they_lie() -> None:
    scene = scene_data(
        {
            layout.SPHERE_CENTER: [(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)],
            layout.SPHERE_RADIUS: [7.0, 8.0],
            layout.SPHERE_MATERIAL: [9, 10],
            layout.MAX_DEPTH: [11],
        }
    )
    assert layout.vector_of(scene, layout.SPHERE_CENTER, 1) == (4.0, 5.0, 6.0)
    assert layout.number_of(scene, layout.SPHERE_RADIUS, 0) == 7.0
    assert layout.integer_of(scene, layout.SPHERE_MATERIAL, 1) == 10
    assert layout.integer_of(scene, layout.MAX_DEPTH, 0) == 11
    assert layout.rows_of(scene, layout.SPHERE_CENTER) == 2


def test_a_table_that_is_not_stored_has_no_rows() -> None:
    assert layout.rows_of(scene_data({layout.MAX_DEPTH: [1]}), layout.TRIANGLE_MATERIAL) == 0
