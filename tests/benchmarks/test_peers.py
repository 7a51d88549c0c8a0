import json
import math
from pathlib import Path

import numpy as np
import pytest

from benchmarks import peers
from benchmarks.peer_scenes import MIRROR_DEPTH, diffuse_scene, mirror_scene

pytestmark = pytest.mark.clause("BEN-1")

# So few that the test is quick; no time is asserted.
SIZE = 12
ROUNDS = 3


@pytest.fixture
def printed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    """What the command prints with two pairs of processes."""
    monkeypatch.setattr(peers, "mitsuba_llvm", _Absent)
    peers.main(["--json", "--size", str(SIZE), "--rounds", str(ROUNDS)])
    return capsys.readouterr().out


class _Absent:
    def version(self) -> None:
        """Renders nowhere."""


@pytest.mark.clause("CMD-3")
def test_the_document_has_the_keys_that_other_programs_rely_on(printed: str) -> None:
    document = json.loads(printed)
    assert list(document)[:2] == ["machine", "ratios"]
    assert len(document["ratios"]) == 2
    for ratio in document["ratios"]:
        assert list(ratio)[:6] == ["name", "ours_seconds", "peer_seconds", "ratio", "low", "high"]
        assert all(math.isfinite(value) and value > 0 for key, value in ratio.items() if key.endswith("seconds"))
        assert 0 < ratio["low"] <= ratio["ratio"] <= ratio["high"]
        assert ratio["ours_peak_bytes"] > 0
        assert ratio["peer_peak_bytes"] > 0
        # Both show the same picture but at edges: 12 rows of pixels cross a silhouette or a shadow a few times each.
        assert ratio["pixels_apart"] < 0.1


def test_the_interval_of_the_median_has_the_confidence_asked_for() -> None:
    # Conover's table for n = 20 and p = 1/2: the 6th and the 15th value, at 95.9 %.
    assert peers.ranks_outside(20) == 5
    assert peers.ranks_outside(3) == 0


def test_medians_fall_into_their_intervals_as_often_as_stated() -> None:
    samples = np.sort(np.random.default_rng(7).random((20_000, peers.ROUNDS)), axis=1)
    outside = peers.ranks_outside(peers.ROUNDS)
    covered = np.mean((samples[:, outside] <= 0.5) & (samples[:, -1 - outside] >= 0.5))
    # Six standard deviations of a share of 95 % in 20,000 samples.
    assert covered > peers.CONFIDENCE - 6 * math.sqrt(0.95 * 0.05 / 20_000)


def test_the_mirrors_are_seen_as_deep_as_is_timed() -> None:
    assert mirror_scene(8).max_depth == MIRROR_DEPTH
    assert diffuse_scene(8).max_depth == 0


def test_a_process_that_dies_is_named(tmp_path: Path) -> None:
    worker = peers.Worker("no_such_variant", tmp_path / "scene.xml", tmp_path)
    with pytest.raises(RuntimeError, match=r"timing_worker no_such_variant .* ended without an answer"), worker:
        worker.render()
