import numpy as np
import pytest

from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded

pytestmark = pytest.mark.clause("VER-11")


def test_the_curve_is_a_line_in_the_dark_and_a_power_above():
    linear = np.array([0, 0.001, 0.5, 1])
    # IEC 61966-2-1: linear below 0.0031308, a power of 1/2.4 above.
    power = 1.055 * 0.5 ** (1 / 2.4) - 0.055
    expected = [0, 12.92 * 0.001, power, 1]
    # Python's power and NumPy's, and three roundings behind each: eight units of rounding hold all of them.
    np.testing.assert_allclose(srgb_encoded(linear), expected, rtol=8 * np.finfo(float).eps)


def test_decoding_is_the_inverse_of_encoding():
    linear = np.linspace(0, 1, 1001)
    # The two pieces of the standard's curve meet to some 1e-8 only, so that the inverse is that good there.
    np.testing.assert_allclose(srgb_decoded(srgb_encoded(linear)), linear, atol=1e-7)
