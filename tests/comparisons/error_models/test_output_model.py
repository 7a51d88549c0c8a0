from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.output_model import LARGEST_CODES, OutputModel
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("VER-5")

FORMATS = [numbers for numbers in get_args(get_type_hints(OutputModel)["numbers"]) if numbers != "rgbe"]
"""Those that have numbers for each channel apart."""
MODELS = [
    OutputModel(numbers, transfer, rounding, clipped)
    for numbers in FORMATS
    for transfer in ("linear", "sRGB")
    for rounding in ("nearest", "truncation")
    for clipped in (False, True)
    if clipped or numbers not in LARGEST_CODES
]
# A curve that is evaluated in float32 does not give all digits of a float, so there a neighbour may be right, too.
EXACT = [model for model in MODELS if model.transfer == "linear" or model.numbers in {"uint8", "uint16", "float16"}]
every_model = pytest.mark.parametrize("model", MODELS, ids=OutputModel.in_words)


def curve(x: float) -> float:
    """Written once more, from the standard."""
    if x <= 0.0031308:
        return 12.92 * x
    return 1.055 * math.pow(x, 1 / 2.4) - 0.055


def inverse_curve(y: float) -> float:
    if y <= 0.04045:
        return y / 12.92
    return math.pow((y + 0.055) / 1.055, 2.4)


def to_half(x: float) -> float:
    """Python's own conversion, which refuses what a half cannot hold."""
    try:
        return float(struct.unpack("<e", struct.pack("<e", x))[0])
    except OverflowError:
        return math.copysign(math.inf, x)


def to_single(x: float) -> float:
    try:
        return float(struct.unpack("<f", struct.pack("<f", x))[0])
    except OverflowError:
        return math.copysign(math.inf, x)


CONVERSIONS: dict[str, Callable[[float], float]] = {"float16": to_half, "float32": to_single, "float64": float}


def neighbour(value: float, numbers: str, side: int) -> float:
    """The next number of a format, in the direction of `side`."""
    if numbers in LARGEST_CODES:
        return value + side / LARGEST_CODES[numbers]
    kind: Any = np.dtype(numbers).type
    with np.errstate(over="ignore"):
        return float(np.nextafter(kind(value), kind(side * math.inf)))


def encoded(radiance: float, model: OutputModel) -> float:
    value = min(max(radiance, 0.0), 1.0) if model.clipped else radiance
    return curve(value) if model.transfer == "sRGB" else value


def written(radiance: float, model: OutputModel) -> float:
    """What a plain renderer in float64 writes, as a number of which 1 is white."""
    value = encoded(radiance, model)
    largest = LARGEST_CODES.get(model.numbers)
    if largest is not None:
        return (math.floor(value * largest + 0.5) if model.rounding == "nearest" else int(value * largest)) / largest
    nearest = CONVERSIONS[model.numbers](value)
    if model.rounding == "truncation" and abs(nearest) > abs(value):
        return neighbour(nearest, model.numbers, -1 if nearest > 0 else 1)
    return nearest


def read(number: float, model: OutputModel) -> float:
    return inverse_curve(number) if model.transfer == "sRGB" else number


def interval(model: OutputModel, low: float, high: float) -> tuple[float, float]:
    lowest, highest = model.interval_read([low], [high])
    return float(lowest[0]), float(highest[0])


# From subnormal halves to what no half holds; the ends of everything; a little light below zero, as balls have it.
RADIANCE = st.one_of(
    st.floats(-1e-6, 2.0),
    st.floats(0, 1),
    st.floats(0, 1e-7),
    st.floats(6e4, 7e4),
    st.floats(1e-9, 1e6),
    st.sampled_from([0.0, 1.0, 0.5 / 255, 254.5 / 255, 0.0031308, 2.0**-24, 2.0**-25, 65504.0, 65519.99, 65520.0]),
    st.integers(0, 255).map(lambda code: code / 255),
    st.integers(0, 255).map(lambda code: inverse_curve(code / 255)),
)


@every_model
@given(a=RADIANCE, b=RADIANCE, share=st.floats(0, 1))
def test_what_a_plain_renderer_writes_of_any_radiance_in_the_interval_lies_inside(
    model: OutputModel, a: float, b: float, share: float
) -> None:
    low, high = min(a, b), max(a, b)
    value = min(max(low + share * (high - low), low), high)
    lowest, highest = interval(model, low, high)
    number = written(value, model)
    note_case(low=low, high=high, value=value, number=number, lowest=lowest, highest=highest)
    assert lowest <= read(number, model) <= highest
    assert lowest <= np.float32(read(number, model)) <= highest or model.numbers == "float64"
    if model.numbers not in {"float32", "float64"}:  # the same by way of float32, as many renderers do it
        assert lowest <= read(written(to_single(value), model), model) <= highest


@pytest.mark.parametrize("model", EXACT, ids=OutputModel.in_words)
@given(a=RADIANCE, b=RADIANCE)
def test_one_code_beyond_what_the_ends_may_be_written_as_lies_outside(model: OutputModel, a: float, b: float) -> None:
    low, high = min(a, b), max(a, b)
    # A renderer's own roundings before it writes: 32 of float32, with the half that is added to integers.
    slack = 0.0 if (model.numbers in {"float32", "float64"}) else 32 * 2.0**-24
    beyond = []
    for end, side in ((low, -1), (high, 1)):
        value = encoded(end, model)
        half = 0.5 / LARGEST_CODES.get(model.numbers, math.inf)
        moved = value + side * slack * (abs(value) + half)
        linear = model.__class__(model.numbers, "linear", model.rounding, model.clipped)
        beyond.append(neighbour(written(moved, linear), model.numbers, side))
    lowest, highest = interval(model, low, high)
    note_case(low=low, high=high, beyond=tuple(beyond), lowest=lowest, highest=highest)
    assert read(beyond[0], model) < lowest or math.isinf(lowest)
    assert read(beyond[1], model) > highest or math.isinf(beyond[1])


@every_model
@given(ends=st.lists(RADIANCE, min_size=4, max_size=4))
def test_a_larger_interval_of_radiance_gives_a_larger_interval_of_values(model: OutputModel, ends: list[float]) -> None:
    outer_low, low, high, outer_high = sorted(ends)
    lowest, highest = interval(model, low, high)
    outer_lowest, outer_highest = interval(model, outer_low, outer_high)
    note_case(ends=tuple(ends))
    # The two branches of sRGB do not quite meet: at 0.0031308 the curve falls by 3e-8, read as 3e-9.
    gap = 4e-9 if model.transfer == "sRGB" else 0.0
    assert outer_lowest <= lowest + gap
    assert highest <= outer_highest + gap
    assert lowest <= highest


def test_clipped_radiance_above_one_is_read_as_one_and_below_zero_as_zero() -> None:
    for model in MODELS:
        if model.clipped:
            for radiance, expected in ((1.7, 1.0), (1e30, 1.0), (math.inf, 1.0), (-3.0, 0.0), (0.0, 0.0), (1.0, 1.0)):
                lowest, highest = interval(model, radiance, radiance)
                assert lowest <= expected <= highest
                assert highest - lowest < 0.02  # about a code of 8 bits, and sRGB is steep at 1
        elif model.numbers != "float64":
            assert interval(model, 1.7, 1.7)[0] > 1.69


def test_what_a_half_cannot_hold_is_infinite_or_the_largest_half_as_it_is_rounded() -> None:
    assert interval(OutputModel("float16"), 7e4, 8e4) == (math.inf, math.inf)
    assert interval(OutputModel("float16"), 6.5e4, 8e4)[1] == math.inf
    assert interval(OutputModel("float16", rounding="truncation"), 7e4, 8e4)[1] == 65504.0
    assert interval(OutputModel("float32"), 1e39, 1e39) == (math.inf, math.inf)


def test_subnormal_halves_are_told_apart() -> None:
    step = 2.0**-24
    for code in range(4):
        lowest, highest = interval(OutputModel("float16"), code * step, code * step)
        assert (lowest, highest) == ((code - 0.5) * step, (code + 0.5) * step)


def test_what_is_not_a_number_stays_so_and_shapes_are_kept() -> None:
    for model in MODELS:
        low, high = model.interval_read(np.full((2, 3), np.nan), np.full((2, 3), np.nan))
        assert low.shape == high.shape == (2, 3)
        assert np.isnan(low).all()
        assert np.isnan(high).all()


def test_codes_are_read_as_the_values_they_stand_for() -> None:
    assert OutputModel("uint8", clipped=True).linear_values(np.array([0, 51, 255], np.uint8)).tolist() == [
        0.0,
        0.2,
        1.0,
    ]
    # The standard's curve at 188 of 255, by another way than the code's.
    expected = math.exp(2.4 * math.log((188 / 255 + 0.055) / 1.055))
    (read_back,) = OutputModel("uint8", "sRGB", clipped=True).linear_values([188])
    assert read_back == pytest.approx(expected, rel=1e-12)
    assert OutputModel("float16").linear_values(np.float16([0.1])).tolist() == [float(np.float16(0.1))]


@pytest.mark.parametrize("numbers", LARGEST_CODES)
def test_integers_are_always_clipped(numbers: Any) -> None:
    with pytest.raises(ValueError, match="clipped"):
        OutputModel(numbers)


def test_the_words_name_every_field() -> None:
    assert OutputModel("uint8", "sRGB", "truncation", clipped=True).in_words() == (
        "uint8, sRGB, truncated, clipped to [0, 1]"
    )
    assert len({model.in_words() for model in MODELS}) == len(MODELS)


def read_from_brackets(value: float, largest: int) -> float:
    """Written once more: the brightest of the exposures 1, 1/2, 1/4, … at which the code is not the largest."""
    exposure = 1.0
    while (code := min(largest, math.floor(value * exposure * largest + 0.5))) == largest:
        exposure /= 2
    return code / largest / exposure


@given(st.floats(0, 1e9), st.sampled_from(["uint8", "uint16"]), st.floats(-1, 1))
def test_what_brackets_read_is_allowed_and_two_codes_beside_it_are_not(
    value: float, numbers: Any, error: float
) -> None:
    error_bound = 1e-3
    note_case(value=value, numbers=numbers, error=error)
    model = OutputModel(numbers, bracketed=True, color_error=error_bound)
    computed = max(0.0, value + error * error_bound * max(1.0, value))
    low, high = model.interval_read(value, value)
    read = read_from_brackets(computed, LARGEST_CODES[numbers])
    assert low <= read <= high
    step = 2 ** max(0, math.frexp(high)[1]) / LARGEST_CODES[numbers]
    assert high - low <= 2 * error_bound * max(1.0, value) + 3 * step


def test_only_linear_integers_are_bracketed_and_are_not_clipped_as_well() -> None:
    for options in ({"numbers": "float16"}, {"transfer": "sRGB"}, {"clipped": True}):
        with pytest.raises(ValueError, match="bracketed"):
            OutputModel(**({"numbers": "uint16"} | options), bracketed=True)  # type: ignore[arg-type]  # wrong on purpose


def test_brackets_and_errors_of_colours_are_told_in_words() -> None:
    words = OutputModel("uint16", bracketed=True, color_error=0.25).in_words()
    assert words == (
        "uint16, linear, rounded to the nearest, at the brightest of the exposures 1, 1/2, 1/4, … that does not clip, "
        "of colours computed within 0.25"
    )


def ward_rgbe(color: tuple[float, ...], *, rounds: bool) -> list[float]:
    """What is read of a colour that is written as Ward does ("Real Pixels", Graphics Gems II), or as who rounds does.

    Ward decodes with half a code more. Who rounds up to 256 takes the next exponent.
    """
    if max(color) <= 1e-32:
        return [0.0, 0.0, 0.0]
    exponent = math.frexp(max(color))[1]
    if rounds and round(math.ldexp(max(color), 8 - exponent)) == 256:
        exponent += 1
    scaled = [math.ldexp(channel, 8 - exponent) for channel in color]
    codes = [round(number) if rounds else math.floor(number) for number in scaled]
    return [math.ldexp(code + (0.0 if rounds else 0.5), exponent - 8) for code in codes]


@given(
    color=st.tuples(*[st.one_of(st.just(0.0), st.floats(1e-34, 1e12), st.floats(0.0, 2.0))] * 3), rounds=st.booleans()
)
def test_of_a_shared_exponent_what_is_read_lies_within_a_code_of_the_brightest_channel(
    color: tuple[float, ...], rounds: bool
) -> None:
    low, high = OutputModel("rgbe").interval_read(np.array(color), np.array(color))
    read = np.array(ward_rgbe(color, rounds=rounds))
    assert ((low <= read) & (read <= high)).all()
    # 256 codes are less than twice the brightest; a hundredth of it that is amiss is found.
    assert ((high - low) <= max(2 / 128 * max(color) * 1.001, 2e-32)).all()
    with pytest.raises(ValueError, match="linear"):
        OutputModel("rgbe", transfer="sRGB")


@given(
    st.floats(2.0**-60, 2.0**60, width=32),
    st.one_of(st.just(255.0), st.floats(2.0**-20, 2.0**20), st.integers(-20, 20).map(lambda power: 2.0**power)),
)
def test_what_is_written_times_a_scale_is_read_within_its_interval(radiance: float, scale: float) -> None:
    model = OutputModel(scale=scale)
    low, high = model.interval_read([radiance], [radiance])
    # A tracer in float32 and one in float64: both write float32, and both times the value is read in float32.
    for number in (np.float32, np.float64):
        written = np.float32(number(radiance) * number(scale))
        read = np.float32(model.linear_values(written))
        assert low[0] <= read <= high[0]
    assert high[0] - low[0] <= 2.0**-20 * radiance
    with pytest.raises(ValueError, match="above 0"):
        OutputModel(scale=-scale)
