import numpy as np
import pytest

from raytruth.comparisons.measures import picture_metrics as module
from raytruth.comparisons.measures.picture_metrics import picture_metrics
from raytruth.comparisons.measures.picture_metrics_worker import colour, displayable, flip, largest_delta_e, srgb, ssim

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
        "flip(*pictures)}", "__import__('time').sleep(60)}"
    )
    (tmp_path / "worker.py").write_text(hanging)
    monkeypatch.setattr(module, "WORKER", tmp_path / "worker.py")
    assert picture_metrics(pairs_of(1)) == [{"ssim": None, "delta_e_2000": 0}]


def test_pictures_are_clipped_and_encoded_as_srgb(tmp_path):
    np.save(tmp_path / "image.npy", np.array([-1, 0, 0.001, 0.5, 1, 9], dtype=np.float32))
    linear = displayable(str(tmp_path / "image.npy"))
    encoded = srgb(linear)
    # IEC 61966-2-1: linear below 0.0031308, a power of 1/2.4 above.
    power = 1.055 * 0.5 ** (1 / 2.4) - 0.055
    np.testing.assert_allclose(
        encoded, [0, 0, 12.92 * float(np.float32(0.001)), power, 1, 1], rtol=8 * np.finfo(float).eps
    )


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
    assert round(float(colour.delta_E(*pair, method="CIE 2000")), 4) == 2.0425
