from __future__ import annotations

from typing import Any

import pytest

from raytruth.reference_tracer.pixel_proof import PixelProof, pixel_proof, what_is_wrong
from raytruth.scenes.library import open_scene

pytestmark = pytest.mark.clause("REP-14")

SCENE = open_scene("glass-sphere")
PROOF = pixel_proof(SCENE, 32, 32)


def changed(**changes: Any) -> PixelProof:
    return PROOF.model_copy(update=changes)


def test_a_proof_holds_its_pixels_value_and_comes_back_from_json_the_same() -> None:
    colour = PROOF.explanation.sum
    # The ray tree is in Python floats: its sum may be some roundings off the truth, of 1e-16 each.
    assert all(low - 1e-13 <= c <= high + 1e-13 for low, c, high in zip(PROOF.low, colour, PROOF.high, strict=True))
    assert PixelProof.model_validate_json(PROOF.model_dump_json()) == PROOF
    assert what_is_wrong(SCENE, PROOF) == []


def test_a_wider_enclosure_is_true_as_well_and_a_narrower_or_another_is_not_proven() -> None:
    low, high = PROOF.low, PROOF.high
    wider = changed(low=tuple(c - 1 for c in low), high=tuple(c + 1 for c in high))
    assert what_is_wrong(SCENE, wider) == []
    for claim in (changed(high=low), changed(low=tuple(c + 1 for c in low), high=tuple(c + 1 for c in high))):
        problems = what_is_wrong(SCENE, claim)
        assert len(problems) == 3
        assert all("what can be proven is" in problem for problem in problems)
    assert len(what_is_wrong(SCENE, changed(low=(float("nan"),) * 3))) == 3


def test_every_number_of_the_ray_tree_is_checked() -> None:
    rays = list(PROOF.explanation.rays)
    rays[1] = rays[1].model_copy(update={"weight": (0.5, *rays[1].weight[1:])})
    tree = PROOF.explanation.model_copy(update={"rays": tuple(rays)})
    (problem,) = what_is_wrong(SCENE, changed(explanation=tree))
    assert problem.startswith("explanation.rays.1.weight.0: the proof says 0.5, but it is ")
    short = PROOF.explanation.model_copy(update={"rays": tuple(rays[:-1])})
    assert len(what_is_wrong(SCENE, changed(explanation=short))) == 1


def test_a_proof_of_another_scene_is_refused() -> None:
    assert "another scene" in what_is_wrong(open_scene("single-sphere"), PROOF)[0]
    assert "another scene" in what_is_wrong(SCENE.resized(10, 10), PROOF)[0]


def test_a_value_that_is_left_open_may_not_be_called_decided() -> None:
    open_pixel = pixel_proof(SCENE, 32, 32).model_copy(update={"undecided": "a tie"})
    assert what_is_wrong(SCENE, open_pixel) == []  # it claims less than is known
