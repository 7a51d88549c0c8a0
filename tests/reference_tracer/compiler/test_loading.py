from __future__ import annotations

import ctypes
import platform
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from tests.reference_tracer.compiler.programs import INTEGER, INTEGERS, NUMBER, NUMBERS, compiled

pytestmark = pytest.mark.clause("ARI-12")

# Where in glibc's fenv_t the register is that has the mode, and the mode's bits: DAZ and FTZ of MXCSR; FZ of FPCR.
FLUSHING = {"x86_64": (7, 1 << 6 | 1 << 15), "aarch64": (0, 1 << 24)}
HALF = "def run(a, results):\n    results[0] = 0.5 * a"
SMALLEST_NORMAL = 2.0**-1022


def _halved_where_subnormal_numbers_are_flushed() -> str:
    """What is raised; in a thread of its own, with which the mode ends."""
    library = ctypes.CDLL(None)
    run, results, raised = compiled(HALF, NUMBER, NUMBERS), np.zeros(1), [""]

    def halve() -> None:
        environment = (ctypes.c_uint32 * 16)()
        library.fegetenv(ctypes.byref(environment))
        place, bits = FLUSHING[platform.machine()]
        environment[place] |= bits
        library.fesetenv(ctypes.byref(environment))
        try:
            run(SMALLEST_NORMAL, results)
        except RuntimeError as error:
            raised[0] = str(error)

    thread = threading.Thread(target=halve)
    thread.start()
    thread.join()
    return raised[0]


@pytest.mark.clause("NUM-2")
def test_subnormal_numbers_are_computed_with_and_nothing_runs_where_they_are_flushed() -> None:
    results = np.zeros(1)
    compiled(HALF, NUMBER, NUMBERS)(SMALLEST_NORMAL, results)
    assert results[0] == 2.0**-1023
    assert "flush subnormal numbers" in _halved_where_subnormal_numbers_are_flushed()


def test_threads_run_the_same_function_side_by_side() -> None:
    text = "def run(first, end, results):\n    for i in range(first, end):\n        results[i] = i * i"
    run, results = compiled(text, INTEGER, INTEGER, INTEGERS), np.zeros(4000, dtype=np.int64)
    with ThreadPoolExecutor(4) as threads:
        list(threads.map(lambda band: run(1000 * band, 1000 * (band + 1), results), range(4)))
    assert results.tolist() == [i * i for i in range(4000)]


def test_functions_of_one_name_from_two_texts_stay_apart() -> None:
    results = np.zeros(1)
    one, other = (
        compiled(f"def run(a, results):\n    results[0] = a + {number}", NUMBER, NUMBERS) for number in (1.0, 2.0)
    )
    other(0.0, results)
    assert results[0] == 2.0
    one(0.0, results)
    assert results[0] == 1.0
