from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.dielectric import index_ratio, medium_beyond
from raytruth.scenes.features import Feature
from tests.reference_tracer.kernels import EXACT, exact_kernel, scene_data

WATER, GLASS, CLASSICAL = 0, 1, 2
KS, KT = (Fraction(1, 8), Fraction(2, 8), Fraction(3, 8)), (Fraction(5, 8), Fraction(4, 8), Fraction(3, 8))
SCENE = scene_data(
    {
        layout.MATERIAL_INDEX: [Fraction(4, 3), Fraction(3, 2), Fraction(3, 2)],
        layout.MATERIAL_OUTSIDE: [-1, WATER, -1],
        layout.MATERIAL_OUTSIDE_INDEX: [Fraction(1), Fraction(4, 3), Fraction(1)],
        layout.MATERIAL_HAS_CONSTANT_SPLIT: [0, 0, 1],
        layout.MATERIAL_REFLECTANCE: [(Fraction(0),) * 3, (Fraction(0),) * 3, KS],
        layout.MATERIAL_TRANSMITTANCE: [(Fraction(0),) * 3, (Fraction(0),) * 3, KT],
    }
)
HEAD_ON: Any = (Fraction(1), Fraction(3, 2), Fraction(3, 2))
REFLECTANCE = Fraction(1, 25)


@pytest.mark.clause("REFR-1")
def test_the_ratio_is_the_index_beyond_over_the_index_before() -> None:
    assert index_ratio(SCENE, GLASS, True) == Fraction(9, 8)
    assert index_ratio(SCENE, GLASS, False) == Fraction(8, 9)


@pytest.mark.clause("REFR-9")
def test_what_lies_beyond_is_the_material_or_what_it_is_in() -> None:
    assert medium_beyond(SCENE, GLASS, True) == GLASS
    assert medium_beyond(SCENE, GLASS, False) == WATER
    assert medium_beyond(SCENE, WATER, False) == -1


@pytest.mark.clause("REFR-5")
def test_light_is_split_by_fresnel_and_radiance_scaled_by_the_index_squared() -> None:
    reflected, transmitted = exact_kernel().split(SCENE, GLASS, *HEAD_ON)
    assert reflected == (REFLECTANCE,) * 3
    assert transmitted == ((1 - REFLECTANCE) / Fraction(9, 4),) * 3


@pytest.mark.clause("REFR-5")
def test_the_classical_convention_scales_no_radiance() -> None:
    classical = make_kernel(EXACT, set(Feature) - {Feature.RADIOMETRIC})
    assert classical.split(SCENE, GLASS, *HEAD_ON) == ((REFLECTANCE,) * 3, (1 - REFLECTANCE,) * 3)


@pytest.mark.clause("REFR-6")
def test_a_constant_split_replaces_fresnel_and_total_reflection() -> None:
    kernel = exact_kernel()
    assert kernel.split(SCENE, CLASSICAL, *HEAD_ON) == (KS, KT)
    assert kernel.total_reflection_weight(SCENE, CLASSICAL) == KS
    assert kernel.total_reflection_weight(SCENE, GLASS) == (1, 1, 1)
