from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raytruth.scenes.wording import LONGEST_QUOTE, described, place, quoted, suggestion

pytestmark = pytest.mark.clause("SCN-1")


@settings(deadline=None)  # the machine may be busy
@given(st.text())
def test_a_quoted_text_is_printable_and_short(text: str) -> None:
    assert quoted(text).isprintable()
    # A control character is escaped with six characters at most, a character beyond the first plane with twelve.
    assert len(quoted(text)) <= 12 * LONGEST_QUOTE + 8


def test_places_read_as_in_the_documentation() -> None:
    assert place(("objects", 3, "radius")) == "objects[3].radius"
    assert place(("materials", "dark-red", "diffuse")) == "materials.dark-red.diffuse"
    assert place(("materials", "dark red", "diffuse")) == "materials.'dark red'.diffuse"
    assert place(()) == "the whole file"


def test_values_are_named_as_json_names_them() -> None:
    values = [None, True, False, 1, 0.5, "a", [1, 2], {"a": 1}]
    assert [described(value) for value in values] == [
        "null",
        "true",
        "false",
        "1",
        "0.5",
        "'a'",
        "a list of 2",
        "an object",
    ]


def test_a_near_word_is_suggested_and_otherwise_all_known_ones() -> None:
    assert suggestion("radus", ["radius", "center"]) == "did you mean 'radius'?"
    assert suggestion("xyz", ["radius", "center"]) == "known are 'center', 'radius'."
    assert suggestion("xyz", []) == "there are none."
