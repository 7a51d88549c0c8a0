"""Cells of VTK's, judged as the matrix judges them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.verdict import Expectation, expectation_of
from raytruth.comparisons.matrix.cell import run_cell
from raytruth.comparisons.renderers.vtk.adapter import Vtk
from tests.comparisons.matrix.cell_places import place_of

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell
    from raytruth.scenes.scene import Scene

# Set where every reference must be there (.ci/run): a missing one then fails its tests instead of leaving them out.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))
needs_vtk = pytest.mark.skipif(not REQUIRE_ALL and Vtk().version() is None, reason="VTK cannot draw here")


def expectation_for(scene: Scene, *, with_colors: bool) -> Expectation:
    """What a scene's cells are judged by; the truth that they are shown beside is black."""
    truth = np.zeros((scene.camera.height, scene.camera.width, 3))
    feasible = feasible_set(scene, Vtk.error_model, with_colors=with_colors)
    return expectation_of(scene, truth, feasible)


def cell_of(scene: Scene, integrator: str, folder: Path, expectation: Expectation | None = None) -> Cell:
    """VTK's cell of a scene."""
    expectation = expectation or expectation_for(scene, with_colors=integrator == "local")
    return run_cell(place_of(scene, Vtk(), integrator), 0, expectation, folder)
