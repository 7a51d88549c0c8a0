import re

import pytest

from raytruth.reference_tracer.explanation import explain
from raytruth.reports.explanation_text import explanation_text
from raytruth.scenes.library import open_scene

pytestmark = pytest.mark.clause("ARI-7")


def test_the_text_has_one_block_a_ray_indented_by_its_level() -> None:
    tree = explain(open_scene("glass-and-mirror"), 30, 34)
    heads = re.findall(r"^( *)ray (\d+): (\w+)", explanation_text(tree), re.MULTILINE)
    assert [int(number) for _, number, _ in heads] == [ray.number for ray in tree.rays]
    indents = [len(blanks) // 4 for blanks, _, _ in heads]
    for ray in tree.rays:
        assert indents[ray.number] == (0 if ray.parent is None else indents[ray.parent] + 1)


def test_hexadecimal_numbers_are_the_exact_sum() -> None:
    tree = explain(open_scene("phong-sphere"), 40, 40)
    last = explanation_text(tree, hexadecimal=True).splitlines()[-1]
    found = re.findall(r"-?0x[0-9a-f.]+p[+-]\d+", last)
    assert tuple(map(float.fromhex, found)) == tree.sum


def test_formulas_follow_the_convention() -> None:
    classical = explanation_text(explain(open_scene("phong-sphere"), 40, 40))
    radiometric = explanation_text(explain(open_scene("single-sphere"), 48, 48))
    assert "kd·Od·(n·l) + ks·Os·(r·v)^n" in classical
    assert "without a unit" in classical
    assert "ρ/π·(n·l)" in radiometric
    assert "W/(m²·sr)" in radiometric


@pytest.mark.clause("REP-2")
def test_names_cannot_smuggle_terminal_escapes_in() -> None:
    scene = open_scene("single-sphere").model_copy(update={"name": "evil\x1b[2J"})
    assert "\x1b" not in explanation_text(explain(scene, 0, 0))
