import warnings

import numpy as np
import pytest

from raytruth.comparisons.measures import picture_metrics as module
from raytruth.comparisons.measures.picture_metrics import picture_metrics
from raytruth.comparisons.measures.picture_metrics_worker import (
    delta_e_2000,
    displayable,
    flip,
    largest_delta_e,
    ssim,
)

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # at its import, colour tells whoever lacks its optional plotting library
    import colour

pytestmark = pytest.mark.clause("VER-11")

# Stands in for the worker: measures every pair alike, and does something else at pair 1.
WORKER = """
import json, os, sys
with open("measured.jsonl", "a") as file:
    for number in sys.argv[1:]:
        print(json.dumps({{"pair": int(number), "ssim": 0.5}}), file=file, flush=True)
        if number == "1":
            {trouble}
        print(json.dumps({{"pair": int(number), "flip": 0.25}}), file=file, flush=True)
"""
WHOLE = {"ssim": 0.5, "flip": 0.25}


def pairs_of(count):
    return [(np.zeros((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32))] * count


@pytest.mark.parametrize(
    "trouble",
    ["os.abort()", "sys.exit(3)", "os._exit(0)", "file.write('{'); file.flush(); os.abort()"],
)
def test_a_pair_that_stops_the_worker_costs_only_its_own_measure(tmp_path, monkeypatch, trouble):
    worker = tmp_path / "worker.py"
    worker.write_text(WORKER.format(trouble=trouble))
    monkeypatch.setattr(module, "WORKER", worker)
    assert picture_metrics(pairs_of(4)) == [WHOLE, {"ssim": 0.5}, WHOLE, WHOLE]


def test_a_worker_that_cannot_start_leaves_all_pairs_without_measures(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "WORKER", tmp_path / "missing.py")
    assert picture_metrics(pairs_of(3)) == [{}, {}, {}]


def test_the_watchdog_ends_a_worker_that_hangs_in_flip(tmp_path, monkeypatch):
    source = module.WORKER.read_text()
    assert "SECONDS_TO_SPARE = 60" in source
    hanging = source.replace("SECONDS_TO_SPARE = 60", "SECONDS_TO_SPARE = 0.2").replace(
        "flip(render, truth)}", "__import__('time').sleep(60)}"
    )
    (tmp_path / "worker.py").write_text(hanging)
    monkeypatch.setattr(module, "WORKER", tmp_path / "worker.py")
    assert picture_metrics(pairs_of(1)) == [{"ssim": None, "delta_e_2000": 0}]


def test_pictures_are_clipped_before_they_are_measured(tmp_path):
    np.save(tmp_path / "image.npy", np.array([-1, 0, 0.5, 1, 9], dtype=np.float32))
    np.testing.assert_array_equal(displayable(str(tmp_path / "image.npy")), [0, 0, 0.5, 1, 1])


def test_delta_e_of_colours_agrees_with_another_library():
    pictures = np.random.default_rng(0).random((2, 16, 16, 3))
    labs = [colour.XYZ_to_Lab(colour.sRGB_to_XYZ(picture)) for picture in pictures]
    expected = colour.delta_E(*labs, method="CIE 2000").max()
    # The standard states the matrix to four decimals, with which colour computes; the other is that of the primaries.
    assert largest_delta_e(*pictures) == pytest.approx(expected, rel=1e-3)


def test_ssim_falls_with_noise_and_needs_a_whole_window():
    rng = np.random.default_rng(0)
    truth = rng.random((11, 11, 3))
    noise = 0.1 * rng.standard_normal(truth.shape)
    assert ssim(truth, truth) == 1
    assert ssim(truth, truth + 2 * noise) < ssim(truth, truth + noise) < 1
    assert ssim(truth[:10], truth[:10]) is None


def test_flip_and_delta_e_are_symmetric_where_they_should_be_and_look_at_color():
    truth, render = np.full((8, 8, 3), 0.5), np.full((8, 8, 3), 0.5)
    render[0, 0] = (0.5, 0.4, 0.5)
    assert largest_delta_e(render, truth) == largest_delta_e(truth, render) > 5
    assert flip(render, truth) > 0
    # Sharma, Wu, Dalal 2005, table 1: pair 1 of their test data has ΔE2000 = 2.0425.
    pair = [np.array([50.0, 2.6772, -79.7751]), np.array([50.0, 0.0, -82.7485])]
    assert round(float(delta_e_2000(*pair)), 4) == 2.0425
