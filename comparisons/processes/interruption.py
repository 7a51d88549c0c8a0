"""What an interruption (Ctrl-C) and the death of a run mean to the processes that work for it.

A terminal sends an interruption to the run and to all its workers. The run tells of it; a worker ends its task quietly.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from contextlib import contextmanager
from multiprocessing import parent_process, resource_tracker
from typing import TYPE_CHECKING

from raytruth.reference_tracer.certified_image import collect_garbage_rarely

if TYPE_CHECKING:
    from collections.abc import Iterator

INTERRUPTED = 130
"""What a process that is interrupted ends with, as shells have it."""

_busy = threading.Event()
"""Set while this process works at a task."""


@contextmanager
def interruption_held_back() -> Iterator[None]:
    """Hold an interruption back while processes are started: they would tell of it before they are set up.

    They inherit that it is blocked. In this process it may still reach another thread, so that its handler holds it
    back as well. To be called from the main thread.
    """
    resource_tracker.ensure_running()  # it would lift the block when it starts by itself
    heard = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: heard.set())
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        signal.signal(signal.SIGINT, before)
        if heard.is_set():
            signal.raise_signal(signal.SIGINT)


def start_worker() -> None:
    """Set up a process of a run: it ends when the run is gone, and its task when it is interrupted."""
    collect_garbage_rarely()
    signal.signal(signal.SIGINT, _end_task)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    threading.Thread(target=_end_with_parent, daemon=True).start()


@contextmanager
def at_work() -> Iterator[None]:
    """Let an interruption end a task of a worker, but not its waiting, which could break off inside a message."""
    _busy.set()
    try:
        yield
    finally:
        _busy.clear()


def _end_task(*_: object) -> None:
    if _busy.is_set():
        sys.exit(INTERRUPTED)


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None, "only workers are set up"
    parent.join()
    os._exit(INTERRUPTED)  # what renders in a process of its own is ended by its guard
