from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.renderers.program.declaration import PLACEHOLDERS, Declaration
from raytruth.comparisons.renderers.program.declaration_file import (
    LARGEST_FILE,
    DeclarationError,
    checked_declaration,
    load_declaration,
)
from raytruth.comparisons.renderers.program.declaration_schema import json_schema
from raytruth.comparisons.renderers.program.starting_file import starting_text
from tests.rooms import ROOT

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-8")

LEAST = 'name = "mine"\ncommand = ["./tracer", "{scene}", "{output}"]\n'


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "mine.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def mistakes_of(folder: Path, text: str | bytes) -> tuple[str, ...]:
    """The sentences about a file, each without the file's name."""
    path = written(folder, text)
    with pytest.raises(DeclarationError) as raised:
        load_declaration(path)
    assert str(raised.value) == "\n".join(raised.value.problems)
    for sentence in raised.value.problems:
        assert sentence.startswith(f"{path}: ")
        assert "\n" not in sentence
        assert sentence.endswith((".", "?"))
    return tuple(sentence.removeprefix(f"{path}: ") for sentence in raised.value.problems)


def test_a_name_and_a_command_are_enough(tmp_path: Path) -> None:
    declaration = load_declaration(written(tmp_path, LEAST))
    assert declaration.command == ("./tracer", "{scene}", "{output}")
    assert (declaration.reads, declaration.writes, declaration.limits.seconds) == ("json", "exr", 60)


def test_the_file_to_start_from_loads_as_it_is_and_so_does_each_of_its_lines_that_is_commented_out(
    tmp_path: Path,
) -> None:
    text = starting_text("mine")
    assert load_declaration(written(tmp_path, text)).name == "mine"
    lines = text.split("\n")
    commented = [number for number, line in enumerate(lines) if line.startswith("# ") and " = " in line]
    assert len(commented) >= 15
    for number in commented:
        line = lines[number].removeprefix("# ")
        # Of a program that draws random numbers the command must have a seed.
        more = text.replace('"{output}"]', '"{output}", "{seed}"]') if line.startswith("samples") else text
        one = more.replace(lines[number], line)
        if line.startswith("family"):
            one = one.replace(line, f"reference = true\n{line}")
        one = one.replace('own_surface = "excluded"', 'own_surface = "tested"')
        load_declaration(written(tmp_path, one))


def test_all_mistakes_are_told_at_once_each_with_its_place(tmp_path: Path) -> None:
    text = """
nam = "mine"
name = "My Tracer"
command = ["./tracer", "{scen}", "{output}", 7]
writes = "bmp"
version = "1"
[limits]
seconds = -1
memory = 100
[scenes]
refuses = ["checkerbord"]
[rays]
offset = "1e-4"
own_surface = "excluded"
least_distance = 1e-3
[formulas]
sphere = "geometric"
[arithmetic]
bits = 30
precision = "float32"
"""
    assert mistakes_of(tmp_path, text) == (
        "name: expected lower-case letters, digits and hyphens, at most 40, the first of them a letter.",
        "command[1]: expected no placeholder 'scen' in braces; did you mean 'scene'?",
        "command[3]: expected a text in quotes, found 7.",
        "version: expected a list in square brackets, found '1'.",
        "writes: expected 'exr', 'pfm', 'hdr', 'ppm' or 'png', found 'bmp'.",
        "limits.seconds: expected a number above 0, found -1.",
        "limits.memory: expected no key 'memory' here; did you mean 'memory_mib'?",
        "scenes.refuses[0]: there is no feature 'checkerbord'; did you mean 'checkerboard'?",
        "rays.offset: expected a number, found '1e-4'.",
        "nam: expected no key 'nam' here; did you mean 'name'?",
        "arithmetic.bits: expected either precision or bits, found both; leave one out.",
    )


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ("numbers = 'uint16'", "numbers: expected 'float' or 'half' in exr, found 'uint16'."),
        ("writes = 'png'\nclipped = false", "clipped: expected true, since whole numbers hold nothing above 1."),
        ("writes = 'hdr'\ncolours = 'srgb'", "colours: expected 'linear' in hdr, found 'srgb'."),
        ("formulas.least_determinant = 1e-6", "formulas.least_determinant: expected the triangle test"),
        ("family = 'mine'", "family: expected reference = true beside it"),
        ("files = ['/src/*.py']", "files[0]: expected a pattern as src/**/*.py: from the folder of this file"),
        ("files = ['src/**.py']", "files[0]: expected a pattern as src/**/*.py"),
        ("sampling.samples = 4", "command: expected the placeholder {seed}, since samples are drawn; add it."),
        ("arithmetic = { precision = 'float32', slack_bits = 20 }", "arithmetic.slack_bits: expected to leave 8 bits"),
        ("formulas.triangle_points = 'barycentric'", "formulas.triangle_points: expected 'along the ray'"),
        ("environment = { 'A=B' = '1' }", "environment.'A=B': expected the name of a variable"),
        (
            "[formulas]\ntriangle = 'plane and inside'\ntriangle_points = 'barycentric'",
            "formulas.triangle_points: expected 'along the ray' with the triangle test 'plane and inside'",
        ),
        ("conventions.handedness = 'both'", "conventions.handedness: expected 'right' or 'left', found 'both'."),
        ("conventions.scale = 0.0", "conventions.scale: expected a number above 0, found 0.0."),
        (
            "conventions.field_of_view = 'horizontal'\narithmetic.precision = 'float64'",
            "arithmetic.precision: expected at most 49 bits",
        ),
        (
            "model.constant_weights = [0.6, 0.5]",
            "model.constant_weights: expected two weights that add up to at most 1",
        ),
        (
            "model = { constant_weights = [0.5, 0.5], fresnel = 'schlick' }",
            "model.constant_weights: expected these or fresnel, found both; leave one out.",
        ),
        ("model.lit_from = 'offset point'", "model.lit_from: expected an offset under [rays] with 'offset point'"),
        ("model.textured_at = 'offset point'", "model.textured_at: expected an offset under [rays] with"),
    ],
)
def test_what_contradicts_or_cannot_be_judged_is_refused_at_its_place(more: str, expected: str, tmp_path: Path) -> None:
    (told,) = mistakes_of(tmp_path, LEAST + more)
    assert told.startswith(expected)


def test_samples_are_drawn_through_the_centres_of_pixels(tmp_path: Path) -> None:
    more = "sampling.samples = 4\nconventions.pixel = 'top left'"
    command = '["./tracer", "{scene}", "{output}", "{seed}"]'
    (told,) = mistakes_of(tmp_path, f'name = "mine"\ncommand = {command}\n{more}')
    assert told.startswith("conventions.pixel: expected rays through the centres of pixels, since samples are drawn")


def test_a_command_needs_the_scene_and_the_output(tmp_path: Path) -> None:
    assert mistakes_of(tmp_path, 'name = "mine"\ncommand = ["./tracer"]') == (
        "command: expected the placeholder {scene} in one of the words; add it.",
        "command: expected the placeholder {output} in one of the words; add it.",
    )
    assert mistakes_of(tmp_path, "")[:2] == (
        "name: expected this key, found nothing; add it.",
        "command: expected this key, found nothing; add it.",
    )


@pytest.mark.parametrize(
    "text",
    [b"\xff", b"a = ", b"a = 1\na = 2", b"[" * 50_000, b"a = " + b"[" * 50_000, b"a = " + b"1" * 5000, b"#" * 70_000],
    ids=["no text", "no value", "a key twice", "brackets", "lists", "a long number", "too long"],
)
def test_what_is_no_toml_is_one_sentence(text: bytes, tmp_path: Path) -> None:
    assert len(mistakes_of(tmp_path, text)) == 1
    assert LARGEST_FILE < 70_000


def test_a_file_that_is_not_there_or_is_a_folder_is_one_sentence(tmp_path: Path) -> None:
    for path in (tmp_path / "none.toml", tmp_path, tmp_path / "\0"):
        with pytest.raises(DeclarationError, match="expected a"):
            load_declaration(path)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-5, 5) | st.floats(allow_nan=True) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)
PARTS = sorted(Declaration.model_fields)
TABLES = ["limits", "rays", "arithmetic", "environment"]


@given(
    data=st.dictionaries(st.sampled_from(PARTS) | st.text(max_size=5), JSON, max_size=5),
    deeper=st.dictionaries(
        st.sampled_from(["limits", "rays", "arithmetic", "environment"]),
        st.dictionaries(st.text(max_size=9), JSON, max_size=3),
    ),
)
def test_whatever_is_stated_gives_a_declaration_or_sentences(data: dict[str, Any], deeper: dict[str, Any]) -> None:
    problems: tuple[str, ...] = ()
    try:
        checked_declaration(data | deeper, "mine.toml")
    except DeclarationError as error:
        problems = error.problems
    # Only hypothesis's own names can be right, and the name and the command never are.
    assert problems
    assert [sentence for sentence in problems if "\n" in sentence] == []


def described_keys(schema: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    for part in (schema, *schema["$defs"].values()):
        for name, key in part.get("properties", {}).items():
            referred = schema["$defs"].get(key.get("$ref", "").rpartition("/")[2], {})
            yield name, bool(key.get("description") or referred.get("description"))


def test_the_schema_describes_each_key_and_takes_the_file_to_start_from(tmp_path: Path) -> None:
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    keys = dict(described_keys(schema))
    assert len(keys) > 30
    assert [name for name, is_described in keys.items() if not is_described] == []
    declaration = load_declaration(written(tmp_path, starting_text("mine")))
    stated = json.loads(declaration.model_dump_json(exclude_unset=True))
    jsonschema.Draft202012Validator(schema).validate(stated)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(schema).validate(stated | {"writes": "bmp"})


@pytest.mark.clause("PRJ-2")
def test_the_page_on_renderers_tells_each_key() -> None:
    page = (ROOT / "docs" / "your-renderer.md").read_text(encoding="utf-8")
    keys = {name for name, _ in described_keys(json_schema())}
    assert [name for name in sorted(keys) if f"`{name}`" not in page] == []


def test_the_placeholders_are_told_where_the_command_is() -> None:
    told = str(Declaration.model_fields["command"].description)
    assert [name for name in PLACEHOLDERS if f"{{{name}}}" not in told] == []
    assert [name for name in PLACEHOLDERS if f"{{{name}}}" not in starting_text("mine")] == []
