"""A limit on the processor time that a piece of code may take."""

from __future__ import annotations

import signal
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType


class TookTooLongError(Exception):
    """The code did not end within its limit."""


@contextmanager
def cpu_seconds(limit: float) -> Iterator[None]:
    """Raise TookTooLongError where the body takes longer, in the main thread of a process only.

    Processor time, so that nothing fails because the machine is busy.
    """

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise TookTooLongError(f"more than {limit:.3g} s of processor time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, limit)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)
