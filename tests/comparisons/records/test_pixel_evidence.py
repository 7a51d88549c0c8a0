from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.records.image_files import ImageError, write_channels, write_image
from raytruth.comparisons.records.pixel_evidence import (
    PixelEvidence,
    pixel_evidence,
    read_pixel_evidence,
    write_pixel_evidence,
)

pytestmark = pytest.mark.clause("RES-1")

finite = st.floats(-1e30, 1e30)
widths = st.one_of(st.just(0.0), st.floats(0, 1e-7), st.floats(0, 1e30))


def sample(outcomes: int) -> PixelEvidence:
    """Two rows of three pixels, each with one box less than the one before."""
    random = np.random.default_rng(outcomes)
    low = random.uniform(-1, 1, (2, 3, outcomes, 3))
    high = low + random.uniform(0, 1, low.shape)
    for place in range(6):
        low[place // 3, place % 3, max(outcomes - place, 0) :] = np.nan
    high[np.isnan(low)] = np.nan
    nearest = random.integers(0, outcomes, (2, 3))
    merged, declared = random.integers(0, 2, (2, 2, 3)) > 0
    return pixel_evidence(low, high, nearest, merged, declared)


# More than ten: their names are then not in the order of the alphabet, in which files keep them.
@pytest.mark.parametrize("outcomes", [1, 2, 16])
def test_what_is_written_is_read_back_exactly(outcomes: int, tmp_path: Path) -> None:
    evidence = sample(outcomes)
    write_pixel_evidence(tmp_path / "feasible.exr", evidence)
    back = read_pixel_evidence(tmp_path / "feasible.exr")
    for name in ("low", "high", "nearest", "merged", "declared"):
        np.testing.assert_array_equal(getattr(back, name), getattr(evidence, name), err_msg=name)


@given(finite, widths, st.integers(-3, 3))
def test_a_float32_lies_in_the_kept_interval_exactly_if_it_lies_in_the_true_one(
    low: float, width: float, steps: int
) -> None:
    high = low + width
    kept = pixel_evidence(
        np.full((1, 1, 1, 3), low),
        np.full((1, 1, 1, 3), high),
        np.zeros((1, 1), np.int64),
        *np.zeros((2, 1, 1), bool),
    )
    for end in (low, high):
        value = np.float32(end)
        for _ in range(abs(steps)):
            value = np.nextafter(value, np.float32(np.copysign(np.inf, steps)))
        inside = kept.low[0, 0, 0, 0] <= value <= kept.high[0, 0, 0, 0]
        assert inside == (low <= float(value) <= high), (low.hex(), high.hex(), float(value).hex())


def test_an_end_that_float32_cannot_hold_is_infinite_outward_only() -> None:
    ends = [np.full((1, 1, 1, 3), end) for end in (-1e300, 1e300)]
    kept = pixel_evidence(ends[0], ends[1], np.zeros((1, 1), np.int64), *np.zeros((2, 1, 1), bool))
    largest = np.finfo(np.float32).max
    assert (kept.low == -largest).all()  # infinity itself is not in the interval
    assert (kept.high == largest).all()


def test_a_file_of_another_kind_gets_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "feasible.exr"
    with pytest.raises(ImageError, match="there is no such image file"):
        read_pixel_evidence(path)
    path.write_bytes(b"no image")
    with pytest.raises(ImageError, match="expected an OpenEXR image"):
        read_pixel_evidence(path)
    write_image(path, np.zeros((2, 3, 3), dtype=np.float32))
    with pytest.raises(ImageError, match=r"expected the channels nearest, merged, declared, outcome0\.low\.R"):
        read_pixel_evidence(path)


@pytest.mark.parametrize("channels", [1, 3, 8, 10])
def test_channels_that_make_no_whole_outcomes_are_refused(channels: int, tmp_path: Path) -> None:
    names = [f"channel{place}" for place in range(channels)]
    write_channels(tmp_path / "feasible.exr", np.zeros((2, 3, channels), dtype=np.float32), names)
    with pytest.raises(ImageError, match="expected the channels"):
        read_pixel_evidence(tmp_path / "feasible.exr")


@given(st.lists(st.floats(width=32), min_size=6, max_size=6))
def test_a_strange_place_of_the_nearest_outcome_stays_within_the_outcomes(places: list[float]) -> None:
    names = (
        "nearest",
        "merged",
        "declared",
        *(f"outcome0.{end}.{color}" for end in ("low", "high") for color in "RGB"),
    )
    pixels = np.zeros((2, 3, 9), dtype=np.float32)
    pixels[..., 0] = np.reshape(np.array(places, dtype=np.float32), (2, 3))
    with TemporaryDirectory() as folder:
        path = Path(folder) / "feasible.exr"
        write_channels(path, pixels, names)
        assert (read_pixel_evidence(path).nearest == 0).all()
