from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer import certification
from raytruth.reference_tracer import certified_image as module
from raytruth.reference_tracer.certification import FEWEST_BITS, TWO_ROUNDINGS, Certifier, Enclosure
from raytruth.reference_tracer.certified_image import CertifiedImage, certified_image, largest_value
from raytruth.reference_tracer.compiled_truth import COMPILED_BITS, CompiledTruth
from raytruth.scenes.library import library_names
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene, sphere, square

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.reference_tracer.certification import CertifiedPixel
    from raytruth.reference_tracer.compiled_truth import EnclosedRows
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-6")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache, and bands of two rows of the scene below."""
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))
    monkeypatch.setattr(module, "PIXELS_IN_A_BAND", 2 * WIDTH)
    return tmp_path / "truth"


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, int]]:
    """The pixels that are evaluated from here on, in compiled balls or in Arb's."""
    pixels: list[tuple[int, int]] = []
    original, compiled = Certifier.pixel, CompiledTruth.rows

    def recorded(self: Certifier, column: int, row: int, *widest: float) -> CertifiedPixel:
        pixels.append((column, row))
        return original(self, column, row, *widest)

    def recorded_rows(self: CompiledTruth, first: int, end: int) -> EnclosedRows:
        pixels.extend((column, row) for row in range(first, end) for column in range(self.width))
        return compiled(self, first, end)

    monkeypatch.setattr(Certifier, "pixel", recorded)
    monkeypatch.setattr(CompiledTruth, "rows", recorded_rows)
    return pixels


WIDTH, HEIGHT = 6, 5


def scene() -> Scene:
    return library_scene("single-sphere", WIDTH, HEIGHT)


def touching_scene() -> Scene:
    """Its second row's middle pixel touches a sphere exactly."""
    return small_scene(
        projection="perspective",
        extent=60.0,
        width=3,
        height=3,
        camera={"position": (0.0, 1.0, 2.0)},
        materials={"a": {"emission": {"radiance": (1.0, 0.5, 0.25)}}},
        objects=[sphere("a", (1.0, 0.0, 0.0))],
    )


@pytest.mark.clause("ARI-5")
@pytest.mark.usefixtures("cache")
@pytest.mark.parametrize(("name", "bits"), [("single-sphere", {106}), ("coincident-spheres", {106, 128})])
def test_each_pixel_is_in_its_place(name: str, bits: set[int]) -> None:
    image = certified_image(library_scene(name, WIDTH, HEIGHT))
    certifier = Certifier(library_scene(name, WIDTH, HEIGHT))
    assert image.middle.shape == image.radius.shape == (HEIGHT, WIDTH, 3)
    for row, column in np.ndindex(HEIGHT, WIDTH):
        pixel = certifier.pixel(column, row)
        assert tuple(image.middle[row, column]) == pixel.middle
        # What both arithmetics lose is far below the rounding to float64, which makes the radius.
        assert image.radius[row, column] == pytest.approx(pixel.radius, rel=2.0**-40)
    assert set(image.precision_bits.ravel().tolist()) == bits == {COMPILED_BITS, *bits}
    assert image.decided.all()


@pytest.mark.clause("ARI-8")
@pytest.mark.usefixtures("cache")
@pytest.mark.parametrize("name", ["single-sphere", "coincident-spheres"])
def test_threads_and_processes_side_by_side_give_the_same_image(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PIXELS_WORTH_A_PROCESS", 1)
    told: list[tuple[int, int]] = []
    alone = certified_image(library_scene(name, WIDTH, HEIGHT))
    again = library_scene(name, WIDTH, HEIGHT)
    together = certified_image(again, jobs=2, fresh=True, progress=lambda *done: told.append(done))
    assert_same(alone, together)
    assert told == [(1, 3), (2, 3), (3, 3)]
    needs_arb = bool((alone.precision_bits == FEWEST_BITS).any())
    assert needs_arb == (name == "coincident-spheres")


@pytest.mark.usefixtures("cache")
def test_processes_are_started_only_for_many_pixels() -> None:
    assert [module._processes_for(pixels, 4) for pixels in (0, 999, 1000, 2500, 99_000)] == [1, 1, 2, 3, 4]


def assert_same(one: module.CertifiedImage, other: module.CertifiedImage) -> None:
    np.testing.assert_array_equal(one.middle, other.middle)
    np.testing.assert_array_equal(one.radius, other.radius)
    np.testing.assert_array_equal(one.precision_bits, other.precision_bits)
    assert one.undecided == other.undecided


def test_an_image_is_kept_and_what_is_missing_or_damaged_is_made_again(
    cache: Path, evaluated: list[tuple[int, int]]
) -> None:
    first = certified_image(scene())
    assert len(evaluated) == WIDTH * HEIGHT
    assert_same(certified_image(scene()), first)
    assert len(evaluated) == WIDTH * HEIGHT
    one, two, three = sorted(cache.rglob("*.npz"))
    one.unlink()
    two.write_bytes(two.read_bytes()[:200])
    three.touch()
    evaluated.clear()
    assert_same(certified_image(scene()), first)
    assert sorted({row for _, row in evaluated}) == [0, 1, 2, 3]
    assert sorted(path.suffix for path in one.parent.iterdir()) == [".npz"] * 3
    evaluated.clear()
    certified_image(scene(), fresh=True)
    assert len(evaluated) == WIDTH * HEIGHT


def test_an_image_that_was_interrupted_goes_on_where_it_stopped(cache: Path, evaluated: list[tuple[int, int]]) -> None:
    def interrupt(_done: int, _total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        certified_image(scene(), progress=interrupt)
    assert len(list(cache.rglob("*.npz"))) == 1
    evaluated.clear()
    certified_image(scene())
    assert sorted({row for _, row in evaluated}) == [2, 3, 4]


@pytest.mark.usefixtures("cache")
def test_another_scene_or_size_or_code_of_ours_makes_another_image(
    evaluated: list[tuple[int, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    certified_image(scene())
    certified_image(library_scene("single-sphere", WIDTH, HEIGHT - 1))
    certified_image(library_scene("ambient-sphere", WIDTH, HEIGHT))
    monkeypatch.setattr(module, "source_digest", lambda *_, **__: "another")
    certified_image(scene())
    assert len(evaluated) == WIDTH * (4 * HEIGHT - 1)


@pytest.mark.clause("ARI-5")
@pytest.mark.usefixtures("cache")
def test_undecided_pixels_are_kept_with_their_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(certification, "MOST_WORK", 0)
    monkeypatch.setattr(certification, "MOST_WORK_OF_A_WAY", 0)
    made = certified_image(touching_scene())
    assert list(made.undecided) == [(1, 1)]
    reason = made.undecided[1, 1]
    assert "touches a sphere exactly" in reason.explanation
    assert {outcome.middle for outcome in reason.outcomes} == {(1.0, 0.5, 0.25), (0.0, 0.0, 0.0)}
    assert not made.decided[1, 1]
    assert made.decided.sum() == 8
    assert_same(certified_image(touching_scene()), made)


@pytest.mark.clause("ARI-5")
@pytest.mark.usefixtures("cache")
def test_what_is_wide_against_the_largest_value_gets_more_bits(evaluated: list[tuple[int, int]]) -> None:
    # So small and far that 128 bits leave the point on it, and so its normal, uncertain.
    tiny = small_scene(
        projection="perspective",
        extent=30.0,
        camera={"position": (0.0, 2.0**36, 2.0**37)},
        objects=[sphere("white", radius=2.0**-70)],
        lights=[lamp((0.0, 4.0, 4.0))],
    )
    image = certified_image(tiny)
    assert image.precision_bits.tolist() == [[2 * FEWEST_BITS]]
    assert image.radius.max() <= TWO_ROUNDINGS * largest_value([image])
    assert len(evaluated) == 3  # in compiled balls, and twice in Arb's
    certified_image(tiny)
    assert len(evaluated) == 3


@pytest.mark.clause("ARI-5")
def test_the_largest_value_is_one_that_is_reached_for_certain() -> None:
    image = certified_image(scene())
    image.radius[...] = 0.25
    assert largest_value([image]) == image.middle.max() - 0.25


@pytest.mark.clause("ARI-5")
@pytest.mark.parametrize("name", library_names())
def test_no_pixel_of_a_library_scene_needs_more_than_it_gets(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))
    image = certified_image(library_scene(name, 12, 9))
    assert image.undecided == {}
    assert image.precision_bits.max() <= FEWEST_BITS
    assert image.radius.max() <= TWO_ROUNDINGS * largest_value([image])


@pytest.mark.clause("ARI-5")
@pytest.mark.usefixtures("cache")
def test_a_tie_that_does_not_matter_beside_the_images_largest_value_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    def with_a_faint_tie(glow: float) -> CertifiedImage:
        """A column of three pixels; the one in the middle meets the border of two squares that glow faintly."""
        board = {"even": (0.0,) * 3, "odd": (glow,) * 3, "size": 8.0, "plane": "xy"}
        return certified_image(
            small_scene(
                height=3,
                extent=3.0,
                materials={
                    "board": {"emission": {"radiance": {"checkerboard": board}}},
                    "lamp": {"emission": {"radiance": (1.0, 1.0, 1.0)}},
                },
                objects=[square("board", 0.0, 0.5), sphere("lamp", (0.0, 1.0, 2.0), 0.25)],
            )
        )

    monkeypatch.setattr(certification, "MOST_WORK", 0)
    monkeypatch.setattr(certification, "MOST_WORK_OF_A_WAY", 0)
    assert with_a_faint_tie(2.0**-53).undecided == {}
    assert list(with_a_faint_tie(2.0**-50).undecided) == [(0, 1)]


def test_enclosures_are_equal_by_value() -> None:
    assert Enclosure((1.0, 0.0, 0.0), (0.0,) * 3) == Enclosure((1.0, 0.0, 0.0), (0.0,) * 3)
