from __future__ import annotations

import signal

import pytest

from raytruth.comparisons.processes.time_limit import TookTooLongError, cpu_seconds

pytestmark = pytest.mark.clause("REN-1")


def test_what_does_not_end_is_ended() -> None:
    with pytest.raises(TookTooLongError, match=r"more than 0\.05 s of processor time"):
        _run_for_ever()


def _run_for_ever() -> None:
    with cpu_seconds(0.05):
        while True:
            pass


def test_what_ends_is_left_alone_and_nothing_stays_behind() -> None:
    before = signal.getsignal(signal.SIGVTALRM)
    with cpu_seconds(10.0):
        assert signal.getitimer(signal.ITIMER_VIRTUAL)[0] > 0
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)
    assert signal.getsignal(signal.SIGVTALRM) == before
