"""Whole runs that are killed and interrupted are in tests/meta/test_interrupted_runs.py."""

from __future__ import annotations

import os
import signal
import threading
import time

import pytest

from raytruth.comparisons.processes.interruption import INTERRUPTED, at_work, interruption_held_back, start_worker

pytestmark = pytest.mark.clause("RES-5")


def test_an_interruption_while_processes_start_is_heard_of_afterwards() -> None:
    reached = False
    with pytest.raises(KeyboardInterrupt), interruption_held_back():  # noqa: PT012 - the end of the block raises it
        os.kill(os.getpid(), signal.SIGINT)
        reached = True
    assert reached


def test_an_interruption_that_reaches_another_thread_is_held_back_as_well() -> None:
    ended = threading.Event()
    thread = threading.Thread(target=ended.wait)
    thread.start()
    reached = False
    try:
        with pytest.raises(KeyboardInterrupt), interruption_held_back():  # noqa: PT012 - the end of the block raises it
            os.kill(os.getpid(), signal.SIGINT)  # blocked in this thread, but not in that one
            time.sleep(0.01)  # lets this thread run the handler, if the other has taken the signal
            reached = True
    finally:
        ended.set()
        thread.join()
    assert reached


def test_an_interruption_ends_a_task_and_nothing_else(monkeypatch: pytest.MonkeyPatch) -> None:
    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr("raytruth.comparisons.processes.interruption.collect_garbage_rarely", lambda: None)
    monkeypatch.setattr("raytruth.comparisons.processes.interruption._end_with_parent", lambda: None)
    try:
        start_worker()
        os.kill(os.getpid(), signal.SIGINT)
        with pytest.raises(SystemExit) as end, at_work():
            os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)
    finally:
        signal.signal(signal.SIGINT, before)
    assert end.value.code == INTERRUPTED
