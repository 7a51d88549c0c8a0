from __future__ import annotations

import functools
import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import raytruth
from raytruth.comparisons.records.image_files import read_image
from tests.raytruth.running import run

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-3")

WIDTH, HEIGHT = 16, 12
FLOAT64 = raytruth.ErrorModel(
    "float64, with 2 bits for the mathematical library", precision_bits=51, output=raytruth.OutputModel("float64")
)


@functools.cache
def rendered(name: str) -> tuple[Scene, NDArray[Any]]:
    """In interpreted floats, which need no compiling."""
    scene = raytruth.resized(raytruth.load_scene(name), WIDTH, HEIGHT)
    return scene, raytruth.render(scene, "float")


@functools.cache
def judged(name: str) -> raytruth.ImageJudgement:
    scene, image = rendered(name)
    return raytruth.judge(image, scene, FLOAT64)


@pytest.mark.parametrize("name", raytruth.library_names())
def test_the_tracers_own_image_of_each_scene_passes(name: str) -> None:
    judgement = judged(name)
    assert (judgement.verdict, judgement.failing) == ("pass", 0)
    assert judgement.pixels == WIDTH * HEIGHT
    assert judgement.distances.shape == (HEIGHT, WIDTH)
    assert judgement.worst.tolerances == judgement.distances.max() <= 1


@given(
    column=st.integers(0, WIDTH - 1),
    row=st.integers(0, HEIGHT - 1),
    channel=st.integers(0, 2),
    size=st.floats(1 / 255, 1e6),  # from one code of an 8-bit picture, which can be seen
    sign=st.sampled_from((-1, 1)),
)
def test_a_visible_error_of_one_pixel_fails_that_pixel_and_no_other(
    column: int, row: int, channel: int, size: float, sign: int
) -> None:
    scene, image = rendered("sphere-over-floor")
    right = judged("sphere-over-floor")
    assert right.ambiguous == 0  # else an error might lead to another outcome
    spoiled = image.copy()
    spoiled[row, column, channel] += sign * size
    wrong = raytruth.judge(spoiled, scene, FLOAT64)
    assert (wrong.verdict, wrong.failing) == ("fail", 1)
    assert (wrong.worst.x, wrong.worst.y) == (column, row)
    assert wrong.worst.value == tuple(spoiled[row, column])
    assert wrong.distances[row, column] == wrong.worst.tolerances > 1
    others = np.ones((HEIGHT, WIDTH), dtype=bool)
    others[row, column] = False
    np.testing.assert_array_equal(wrong.distances[others], right.distances[others])


@pytest.mark.clause("VER-1")
@pytest.mark.parametrize("name", ["ambient-sphere", "coincident-spheres"])  # the other has pixels without one truth
def test_the_judgement_is_the_cell_that_the_matrix_makes_of_the_image(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = raytruth.load_scene(name).model_dump(mode="json", exclude={"name"}, exclude_defaults=True)
    document["camera"] |= {"width": WIDTH, "height": HEIGHT}
    path = tmp_path / "small.json"
    path.write_text(json.dumps(document))
    results = tmp_path / "results"
    assert run(capsys, "run", str(path), "--renderer", "raytruth", "--out", str(results))[0] == 0
    (cell,) = json.loads((results / "results.json").read_text())["cells"]
    image = read_image(results / cell["images"]["render"])
    error_model = raytruth.ErrorModel("the one of the renderer raytruth", precision_bits=51)
    found = raytruth.judge(image, raytruth.load_scene(path), error_model)
    assert (found.verdict, found.reason) == (cell["verdict"], cell["reason"])
    counts = {name: getattr(found, name) for name in ("pixels", "failing", "unjudged", "capped", "ambiguous")}
    declared = found.declared and found.declared.model_dump(mode="json")
    assert {**counts, "declared": declared, "worst": found.worst.model_dump(mode="json")} == cell["judgement"]
    distances = read_image(results / cell["images"]["tolerances"]).max(axis=2)
    np.testing.assert_array_equal(found.distances.astype(np.float32), distances)


@pytest.mark.clause("VER-5")
@pytest.mark.parametrize("numbers", ["float16", "float32", "float64"])
def test_an_image_is_judged_as_the_numbers_that_are_declared(numbers: Any) -> None:
    scene, image = rendered("sphere-over-floor")
    model = raytruth.ErrorModel("float64", precision_bits=51, output=raytruth.OutputModel(numbers))
    assert raytruth.judge(image.astype(numbers), scene, model).verdict == "pass"
    coarser = {"float64": "float32", "float32": "float16"}.get(numbers)
    assert coarser is None or raytruth.judge(image.astype(coarser), scene, model).verdict == "fail"


@pytest.mark.clause("VER-4")
def test_a_pixel_of_which_nothing_can_be_said_is_counted_and_has_no_distance() -> None:
    scene = raytruth.resized(raytruth.load_scene("sphere-over-floor"), 4, 3)
    image = raytruth.render(scene, "float")
    judgement = raytruth.judge(image, scene, raytruth.ErrorModel("two bits", precision_bits=2))
    assert (judgement.verdict, judgement.unjudged) == ("incomparable", 4 * 3)
    assert (judgement.distances == -1).all()


@pytest.mark.clause("VER-2")
def test_a_pixel_is_feasible_where_its_value_lies_in_a_box_of_the_feasible_set() -> None:
    scene, image = rendered("glass-sphere")
    model = raytruth.ErrorModel("float32", precision_bits=22)
    feasible = raytruth.feasible_set(scene, model)
    spoiled = image * np.random.default_rng(1).uniform(1 - 1e-6, 1 + 1e-6, image.shape)
    values = spoiled[:, :, np.newaxis]
    inside = ((feasible.low <= values) & (values <= feasible.high)).all(axis=3).any(axis=2)
    assert 0 < inside.sum() < inside.size
    np.testing.assert_array_equal(raytruth.judge(spoiled, scene, model).distances <= 1, inside)


@pytest.mark.clause("VER-10")
@pytest.mark.parametrize(
    ("image", "expected"),
    [
        (np.zeros((HEIGHT, WIDTH)), "expected an image of shape (12, 16, 3) (height, width, RGB), found (12, 16)."),
        (np.zeros((WIDTH, HEIGHT, 3)), "found (16, 12, 3)."),
        (np.zeros((HEIGHT, WIDTH, 4)), "found (12, 16, 4)."),
        (np.zeros((HEIGHT, WIDTH, 3), dtype=np.uint8), "expected an image of float16, float32, float64, found uint8."),
        (np.zeros((HEIGHT, WIDTH, 3), dtype=np.complex128), "found complex128."),
        (np.zeros((HEIGHT, WIDTH, 3), dtype=object), "found object."),
        ([[[0.0, 0.0, 0.0]]], "expected an image as a NumPy array, found list."),
    ],
)
def test_what_is_no_image_of_the_scene_is_refused_in_one_sentence(image: Any, expected: str) -> None:
    scene, _ = rendered("sphere-over-floor")
    with pytest.raises(ValueError, match=f"{re.escape(expected)}$") as caught:
        raytruth.judge(image, scene, FLOAT64)
    assert "\n" not in str(caught.value)


@pytest.mark.clause("VER-10")
def test_an_image_that_holds_nan_is_refused_with_its_first_pixel() -> None:
    scene, image = rendered("sphere-over-floor")
    spoiled = image.copy()
    spoiled[3, 5, 1] = spoiled[7, 2, 0] = np.nan
    with pytest.raises(ValueError, match=r"found 2 pixels that hold NaN, the first of them at column 5, row 3\.$"):
        raytruth.judge(spoiled, scene, FLOAT64)


def test_an_infinite_value_fails_its_pixel() -> None:
    scene, image = rendered("sphere-over-floor")
    spoiled = image.copy()
    spoiled[3, 5, 1] = np.inf
    judgement = raytruth.judge(spoiled, scene, FLOAT64)
    assert (judgement.failing, judgement.worst.x, judgement.worst.y) == (1, 5, 3)
    assert judgement.worst.value[1] == judgement.worst.tolerances == np.inf


def declaration(folder: Path, **further: str) -> Path:
    """A file that declares a program; `further` tables of it hold these lines."""
    path = folder / "mine.toml"
    tables = "".join(f"[{name}]\n{lines}\n" for name, lines in further.items())
    path.write_text(f'name = "mine"\ncommand = ["./mine", "{{scene}}", "{{output}}", "{{seed}}"]\n{tables}')
    return path


@pytest.mark.clause("VER-15")
@pytest.mark.parametrize("as_text", [False, True])
def test_a_file_that_declares_a_program_stands_for_its_error_model(as_text: bool, tmp_path: Path) -> None:
    scene, image = rendered("sphere-over-floor")
    single = image.astype(np.float32)
    single[3, 4] *= 1 + 2**-20  # more than float32's rounding, and less than one of 18 bits
    for bits, verdict in ((39, "fail"), (18, "pass")):
        path = declaration(tmp_path, arithmetic=f"bits = {bits}")
        assert raytruth.judge(single, scene, str(path) if as_text else path).verdict == verdict


@pytest.mark.clause("VER-15")
def test_an_image_that_is_declared_to_be_flipped_is_turned(tmp_path: Path) -> None:
    scene, image = rendered("sphere-over-floor")
    path = declaration(tmp_path, conventions="flip_x = true\nflip_y = true")
    flipped = np.ascontiguousarray(image[::-1, ::-1]).astype(np.float32)
    flipped[0, 1] += 1
    judgement = raytruth.judge(flipped, scene, path)
    assert (judgement.worst.x, judgement.worst.y, judgement.failing) == (WIDTH - 2, HEIGHT - 1, 1)


@pytest.mark.clause("REN-8")
def test_a_file_that_declares_no_program_or_one_that_draws_samples_is_refused(tmp_path: Path) -> None:
    scene, image = rendered("single-sphere")
    with pytest.raises(raytruth.DeclarationError, match="expected a TOML file, found no file"):
        raytruth.judge(image, scene, "nothing.toml")
    with pytest.raises(ValueError, match="one image of random samples cannot be judged"):
        raytruth.judge(image, scene, declaration(tmp_path, sampling="samples = 4"))
