from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path

import numpy as np
import pytest

from raytruth.reports.viewer_assets import CELL_SCRIPTS, OVERVIEW_SCRIPTS, VIEWER, colour_table, script_text, starter
from tests.reports.test_pictures import MACHADO_KINDS, as_seen, lab

SOURCE = Path(str(VIEWER))
TEMPLATES = SOURCE.parent / "templates"
MESSAGES: dict[str, str] = json.loads((SOURCE / "zh-cn.json").read_text(encoding="utf-8"))
SCRIPTS = [name for name in dict.fromkeys((*OVERVIEW_SCRIPTS, *CELL_SCRIPTS)) if (SOURCE / name).exists()]
PLACE = re.compile(r"\{(\w+)\}")

CMCRAMERI_1_10 = {
    "batlow.txt": "918dd393177e126685437f234f4c1f7c8a446437c1c68820f3bc1a8423e91bd1",
    "vik.txt": "60c2abfbffdfd9e7567cfeea1387bfe270eb036efe7262fdd7bf713058bacae2",
}
"""SHA-256 of the tables in the wheel of cmcrameri 1.10."""


@pytest.mark.clause("PRJ-4")
@pytest.mark.parametrize("name", CMCRAMERI_1_10)
def test_tables_of_colours_are_those_of_the_package_and_come_with_its_licence(name: str) -> None:
    content = (SOURCE / "vendored" / name).read_bytes()
    assert hashlib.sha256(content).hexdigest() == CMCRAMERI_1_10[name]
    assert "MIT License" in (SOURCE / "vendored" / "LICENSE-cmcrameri.txt").read_text(encoding="utf-8")


def colours(name: str) -> np.ndarray:
    return np.frombuffer(bytes.fromhex(colour_table(name)), np.uint8).reshape(1, 256, 3) / 255


@pytest.mark.clause("REP-5")
def test_the_sequential_colours_grow_in_lightness_for_colour_blind_eyes_too() -> None:
    for kind in (None, *MACHADO_KINDS):
        lightness = lab(as_seen(colours("batlow"), kind))[0, :, 0]
        assert np.corrcoef(lightness, np.arange(256))[0, 1] > 0.98


@pytest.mark.clause("REP-5")
def test_both_sides_of_the_diverging_colours_differ_for_colour_blind_eyes_too() -> None:
    import colour  # noqa: PLC0415 - test_pictures has imported it without its warning

    for kind in (None, *MACHADO_KINDS):
        seen = lab(as_seen(colours("vik"), kind))[0]
        apart = colour.delta_E(seen[:96], seen[::-1][:96], method="CIE 2000")
        assert apart.min() > 2.3  # the just noticeable difference (Mahy et al. 1994)


@pytest.mark.clause("REP-13")
def test_all_words_of_the_scripts_are_in_the_catalogue() -> None:
    said = set()
    for name in SCRIPTS:
        text = (SOURCE / name).read_text(encoding="utf-8")
        said |= set(re.findall(r'say\("([^"]+)"', text))
        said |= set(re.findall(r'\bname: "([^"]+)"', text))
        said |= set(re.findall(r'(?:choiceOf|sliderOf)\("([^"]+)"', text))
        said |= {
            word for words in re.findall(r'(?:words = |say\()[^;]*?\? "([^"]+)" : "([^"]+)"', text) for word in words
        }
    assert len(said) > 80
    assert said - MESSAGES.keys() <= {"canvas", "WebGL", "English", "中文"}


@pytest.mark.clause("REP-13")
def test_a_translation_has_the_places_of_its_sentence() -> None:
    for sentence, translation in MESSAGES.items():
        assert set(PLACE.findall(translation)) == set(PLACE.findall(sentence)), sentence
        assert translation, sentence


@pytest.mark.clause("REP-2")
def test_only_fixed_names_are_in_the_script_that_loads_the_others() -> None:
    assert all(re.fullmatch(r"[a-z-]+\.js", name) for name in CELL_SCRIPTS)
    assert starter(("a.js",), "x/").count("x/a.js") == 1


@pytest.mark.clause("REP-2")
@pytest.mark.parametrize("name", SCRIPTS)
def test_no_script_makes_markup_or_code_of_text(name: str) -> None:
    text = script_text(name)
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\b|new Function|<script", text)


@pytest.mark.clause("PRJ-1")
@pytest.mark.parametrize("name", SCRIPTS)
def test_scripts_are_strict_short_and_say_what_they_are(name: str) -> None:
    lines = (SOURCE / name).read_text(encoding="utf-8").splitlines()
    assert lines[0] == '"use strict";'
    assert lines[2].startswith("// ")
    assert len(lines) <= 250
