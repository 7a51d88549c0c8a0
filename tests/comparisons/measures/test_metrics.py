import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from raytruth.comparisons.measures import metrics as metrics_module
from raytruth.comparisons.measures.metrics import compute_metrics, compute_metrics_batch
from raytruth.comparisons.records.results import Metrics

pytestmark = pytest.mark.clause("VER-11")


@pytest.fixture
def without_pictures(monkeypatch):
    """Only what is computed in this process, for tests with many examples."""
    monkeypatch.setattr(metrics_module, "picture_metrics", lambda pairs: [{} for _ in pairs])


def gradient(height=16, width=16):
    return np.linspace(0.1, 0.9, height * width * 3, dtype=np.float32).reshape(height, width, 3)


@pytest.fixture(scope="module")
def measured():
    """One batch through the real child process."""
    bright = gradient() * 4
    pairs = {
        "identical": (gradient(), gradient()),
        "brighter": (gradient() + np.float32(0.05), gradient()),
        "small": (gradient(4, 5) * 2, gradient(4, 5)),
        "nan": (np.where(gradient() > 0.5, np.nan, gradient()), gradient()),
        "too bright to see": (np.maximum(bright, 1) * 2, np.maximum(bright, 1)),
        "black": (np.zeros((12, 12, 3), np.float32), np.zeros((12, 12, 3), np.float32)),
        "black and white": (np.ones((12, 12, 3), np.float32), np.zeros((12, 12, 3), np.float32)),
    }
    return dict(zip(pairs, compute_metrics_batch(list(pairs.values())), strict=True))


def test_identical_images_differ_by_nothing_and_have_no_psnr(measured):
    assert measured["identical"] == Metrics(
        largest_difference=0,
        mean_difference=0,
        rmse=0,
        relative_mse=0,
        psnr=None,
        ssim=1,
        flip=0,
        delta_e_2000=0,
    )


def test_a_brighter_image_is_different_in_every_measure(measured):
    brighter = measured["brighter"]
    assert math.isclose(brighter.mean_difference, 0.05, rel_tol=2**-20)  # float32 at 0.95, the difference at 0.05
    assert math.isclose(brighter.psnr, 20 * math.log10(0.9 / 0.05), rel_tol=2**-20)
    assert 0 < brighter.ssim < 1
    assert 0 < brighter.flip < 1
    assert brighter.delta_e_2000 > 1


def test_an_image_smaller_than_the_window_of_ssim_has_all_other_measures(measured):
    values = measured["small"].model_dump()
    assert values.pop("ssim") is None
    assert None not in values.values()


def test_an_image_with_a_value_that_is_not_finite_has_no_measures_and_spoils_no_other(measured):
    assert measured["nan"] == Metrics()
    for wrong in (np.inf, -np.inf, np.float64(1e300)):  # the last is infinite in float32
        assert compute_metrics(np.full((2, 2, 3), wrong), np.zeros((2, 2, 3))) == Metrics()


def test_pictures_are_clipped_at_white(measured):
    values = measured["too bright to see"]
    assert values.rmse > 1
    assert (values.ssim, values.flip, values.delta_e_2000) == (1, 0, 0)


def test_a_black_truth_has_no_psnr_but_flip_sees_what_is_there(measured):
    assert measured["black"].psnr is measured["black and white"].psnr is None
    assert measured["black"].flip == 0
    assert measured["black and white"].flip > 0.5
    assert math.isclose(measured["black and white"].delta_e_2000, 100, abs_tol=1e-3)  # L* of the white point's decimals


IMAGES = arrays.arrays(np.float32, (2, 3, 3), elements=st.floats(0, 8, width=32))


@pytest.mark.usefixtures("without_pictures")
@given(IMAGES, IMAGES)
def test_numeric_measures_obey_their_definitions(render, truth):
    values = compute_metrics(render, truth)
    difference = render.astype(float) - truth.astype(float)
    rounding = 18 * 2.0**-23  # OpenImageIO subtracts in float32 and sums 18 values
    assert math.isclose(values.largest_difference, abs(difference).max(), rel_tol=rounding)
    assert math.isclose(values.rmse, math.sqrt(np.mean(difference**2)), rel_tol=rounding)
    assert values.mean_difference == float(np.mean(difference))
    by_hand = math.fsum(
        float(d) ** 2 / (float(t) ** 2 + 0.01) for d, t in zip(difference.flat, truth.flat, strict=True)
    )
    assert math.isclose(values.relative_mse, by_hand / 18, rel_tol=rounding)
    if values.rmse and truth.any():
        assert math.isclose(10 ** (values.psnr / 20) * values.rmse, truth.max(), rel_tol=rounding)
    else:
        assert values.psnr is None


@pytest.mark.usefixtures("without_pictures")
def test_a_firefly_does_not_improve_the_psnr():
    truth = gradient()
    one, two = truth.copy(), truth.copy()
    one[3, 3], two[3, 3] = 10, 1000
    assert compute_metrics(two, truth).psnr < compute_metrics(one, truth).psnr


@pytest.mark.parametrize("shape", [(4, 4, 4), (4, 4), (0, 4, 3), (4, 5, 3)])
def test_images_of_another_shape_are_refused(shape):
    with pytest.raises(ValueError, match="one shape"):
        compute_metrics(np.zeros(shape), np.zeros((4, 4, 3)))


def test_no_pairs_have_no_metrics():
    assert compute_metrics_batch([]) == []
