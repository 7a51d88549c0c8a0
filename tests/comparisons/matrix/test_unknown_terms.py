"""A material's term that no renderer knows: all refuse it, and no bound is claimed."""

from __future__ import annotations

import pytest

from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.noise.lobes import find_lobes
from raytruth.comparisons.noise.splat_bound import has_splat_bound
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare
from tests.scenes.exporter_scenes import MIRROR, POINT, RED
from tests.scenes.made_up_terms import MADE_UP_TERMS, made_up

RENDERERS = all_renderers()
IN_THE_LIGHT = {"max_depth": 1, "ambient_light": (0.1, 0.1, 0.1)}


@pytest.mark.clause("REN-3", "VER-8")
@pytest.mark.parametrize("name", RENDERERS)
def test_a_renderer_refuses_a_term_that_it_has_never_heard_of(name: str) -> None:
    renderer, plain, scene = RENDERERS[name], made_up(known=RED), made_up("glitter", known=RED)
    assert renderer.refuses(plain) is None
    assert "golden glitter" in str(renderer.refuses(scene))
    for integrator in renderer.integrators:
        if integrator.gives == "first hits":
            continue  # these do not depend on materials
        reason = depth_or_reason(scene, renderer, integrator)
        assert "golden glitter" in str(reason)


@pytest.mark.clause("VER-9")
@pytest.mark.parametrize("name", RENDERERS)
def test_first_hits_do_not_depend_on_what_a_material_is(name: str) -> None:
    scene = made_up("glitter", known=RED)
    for integrator in RENDERERS[name].integrators:
        if integrator.gives == "first hits":
            assert depth_or_reason(scene, RENDERERS[name], integrator) == 0


@pytest.mark.clause("REN-3")
@pytest.mark.parametrize("term", MADE_UP_TERMS)
@pytest.mark.parametrize("name", RENDERERS)
def test_wherever_its_light_comes_from_a_renderer_refuses_it(name: str, term: str) -> None:
    assert RENDERERS[name].refuses(made_up(term, known=RED, **IN_THE_LIGHT)) is not None


@pytest.mark.clause("SCN-6")
def test_the_tracer_makes_no_kernel_that_leaves_it_out() -> None:
    prepare(made_up(known=RED), FLOAT)
    with pytest.raises(KeyError, match="the tracer's source knows no GOLDEN_GLITTER"):
        prepare(made_up("glitter", known=RED), FLOAT)


@pytest.mark.clause("VER-6")
@pytest.mark.parametrize("term", MADE_UP_TERMS)
def test_nobody_claims_to_know_the_brightest_ray(term: str) -> None:
    assert radiance_bound(made_up(known=MIRROR)) is not None
    assert radiance_bound(made_up(term)) is None
    assert radiance_bound(made_up(term, known=MIRROR)) is None


@pytest.mark.clause("VER-6")
@pytest.mark.parametrize("term", MADE_UP_TERMS)
def test_nobody_claims_to_know_the_largest_splat(term: str) -> None:
    assert has_splat_bound(made_up(known=RED, lights=[POINT]))
    assert not has_splat_bound(made_up(term, lights=[POINT]))
    assert not has_splat_bound(made_up(term, known=RED, lights=[POINT]))


@pytest.mark.clause("VER-7")
@pytest.mark.parametrize("term", MADE_UP_TERMS)
def test_nobody_claims_to_know_the_lobes(term: str) -> None:
    assert find_lobes(made_up(known=MIRROR, max_depth=1)).mirrors.max() == 1
    with pytest.raises(ValueError, match=f"the term {term} are not known"):
        find_lobes(made_up(term, known=MIRROR, max_depth=1))
