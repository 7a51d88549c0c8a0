import warnings
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from raytruth.reports import pictures
from tests.reports.sample_results import noise, sphere_image

pytestmark = pytest.mark.clause("REP-5")

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # colour-science says that it cannot plot without matplotlib; nothing here plots
    import colour

MAGENTA = (255, 0, 255)
MACHADO_KINDS = ("Protanomaly", "Deuteranomaly", "Tritanomaly")


@pytest.fixture
def decode(tmp_path: Path) -> "Decoder":
    return Decoder(tmp_path)


class Decoder:
    """Reads a PNG back as 8-bit colours."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "picture.png"

    def __call__(self, png: bytes) -> NDArray[np.uint8]:
        self.path.write_bytes(png)
        pixels = OpenImageIO.ImageBuf(str(self.path)).get_pixels(OpenImageIO.UINT8)
        return np.asarray(pixels)


def constant(value: float) -> pictures.FloatImage:
    return np.full((2, 3, 3), value, dtype=np.float32)


@pytest.mark.clause("OUT-3")
def test_each_code_of_the_tone_is_the_nearest_to_the_srgb_transfer_function(decode: Decoder) -> None:
    # Where the nearest code changes, and the eight floats on either side of it.
    borders = colour.models.eotf_sRGB((np.arange(255) + 0.5) / 255).astype(np.float32)
    light = np.concatenate([borders + step * np.spacing(borders) for step in range(-8, 9)]).astype(np.float32)
    picture = decode(pictures.tone_picture(np.repeat(light[None, :, None], 3, axis=2)))
    expected = np.rint(255 * colour.models.eotf_inverse_sRGB(light.astype(np.float64)))
    assert picture.shape == (1, len(light), 3)
    assert (picture == expected[None, :, None]).all()


@pytest.mark.clause("OUT-3")
def test_light_outside_the_range_is_clipped(decode: Decoder) -> None:
    assert (decode(pictures.tone_picture(constant(7.0))) == 255).all()
    assert (decode(pictures.tone_picture(constant(-1.0))) == 0).all()


@pytest.mark.clause("OUT-3")
@pytest.mark.parametrize("strange", [np.nan, np.inf, -np.inf])
def test_what_is_not_a_finite_number_is_marked_in_every_picture(decode: Decoder, strange: float) -> None:
    image = sphere_image()
    image[3, 5, 1] = strange
    difference = pictures.signed_difference(image, sphere_image())
    tolerances = np.abs(noise())
    tolerances[3, 5] = abs(strange)
    assert tuple(decode(pictures.tone_picture(image))[3, 5]) == MAGENTA
    assert tuple(decode(pictures.difference_picture(difference, 1.0))[3, 5]) == (0, 0, 0)
    assert tuple(decode(pictures.tolerance_picture(tolerances))[3, 5]) == MAGENTA
    assert not (decode(pictures.tone_picture(image))[4:] == MAGENTA).all(axis=-1).any()


@given(st.floats(1e-30, 1e30))
def test_exposure_brings_bright_pixels_into_the_upper_half(brightness: float) -> None:
    exposed = np.float64(np.float32(brightness)) * 2.0 ** pictures.exposure_stops(constant(brightness))
    assert 0.5 < exposed <= 1


def test_a_black_or_empty_of_numbers_image_is_not_brightened() -> None:
    assert pictures.exposure_stops(constant(0.0)) == 0
    assert pictures.exposure_stops(constant(np.nan)) == 0


def test_the_signed_difference_takes_the_channel_that_differs_most() -> None:
    render = constant(0.5)
    render[0, 0] = (0.6, 0.2, 0.5)
    difference = pictures.signed_difference(render, constant(0.5))
    assert difference.shape == (2, 3)
    assert difference[0, 0] == np.float32(0.2) - np.float32(0.5)
    assert (difference.ravel()[1:] == 0).all()


def test_too_dark_is_blue_exact_is_white_too_bright_is_red(decode: Decoder) -> None:
    blue, white, red = decode(pictures.difference_picture(np.array([[-2, 0, 2]], dtype=np.float32), 2.0))[0]
    assert blue[2] > blue[0]
    assert len(set(white)) == 1
    assert white[0] > 240
    assert red[0] > red[2]


def test_the_diverging_scale_reads_the_same_in_lightness_on_both_sides() -> None:
    lightness = lab(pictures._diverging(pictures._ramp()))[..., 0].ravel()
    half = len(lightness) // 2
    assert (np.diff(lightness[:half]) >= 0).all()
    assert (np.diff(lightness[half:]) <= 0).all()


def test_identical_images_give_a_white_difference(decode: Decoder) -> None:
    same = pictures.signed_difference(sphere_image(), sphere_image())
    assert pictures.largest_finite(same) == 0
    assert (decode(pictures.difference_picture(same, 0.0)) > 240).all()


@given(st.floats(width=32))
def test_a_pixel_of_the_error_map_is_marked_if_and_only_if_it_fails(tolerance: float) -> None:
    value = np.array([[tolerance]], dtype=np.float32)
    png = pictures.tolerance_picture(value)
    fails = not (tolerance <= 1)
    assert (png == pictures.tolerance_picture(np.array([[np.inf]], dtype=np.float32))) == fails


def test_unjudged_pixels_are_hatched_in_grey(decode: Decoder) -> None:
    picture = decode(pictures.hatch_legend()).astype(int)
    assert (np.ptp(picture, axis=-1) == 0).all()
    assert len(np.unique(picture)) == 2


def test_the_deviation_is_the_root_of_the_largest_channel() -> None:
    variance = constant(0.0)
    variance[1, 2] = (0.01, 0.25, 0.04)
    assert pictures.deviation_picture(variance)[1] == 0.5


def test_the_sequential_scale_grows_in_lightness() -> None:
    assert (np.diff(lab(pictures._viridis(pictures._ramp()))[..., 0].ravel()) >= 0).all()


@pytest.mark.clause("REP-4")
@pytest.mark.parametrize("kind", [None, *MACHADO_KINDS])
def test_a_mark_differs_from_every_colour_of_its_scale_for_colour_blind_eyes_too(kind: str | None) -> None:
    viridis, hatch = pictures._viridis(pictures._ramp()), np.array([pictures.HATCH])
    diverging = pictures._diverging(pictures._ramp())
    for mark, scale in (
        (pictures.MARK, viridis),
        (pictures.MARK, hatch),
        (pictures.DIFFERENCE_MARK, diverging),
    ):
        colours = lab(as_seen(np.array(mark)[None, None, :], kind))
        distances = colour.delta_E(colours, lab(as_seen(scale, kind)), method="CIE 2000")
        assert distances.min() > 10  # four times 2.3, the just noticeable difference (Mahy et al. 1994)


def as_seen(encoded: NDArray[np.floating], kind: str | None) -> NDArray[np.floating]:
    """sRGB colours as the colour-blind see them (Machado et al. 2009), at full severity."""
    if kind is None:
        return encoded
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # colour-science says that its tritanomaly is an approximation, which will do
        matrix = colour.blindness.matrix_cvd_Machado2009(kind, 1.0)
    light = np.clip(colour.models.eotf_sRGB(np.asarray(encoded, dtype=np.float64)) @ matrix.T, 0, 1)
    return np.asarray(colour.models.eotf_inverse_sRGB(light))


def lab(encoded: NDArray[np.floating]) -> NDArray[np.floating]:
    return np.asarray(colour.XYZ_to_Lab(colour.sRGB_to_XYZ(np.asarray(encoded, dtype=np.float64))))
