"""Profiles for hypothesis: `fast` unless `--hypothesis-profile=deep` is given; and each test names its clauses."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, settings

from raytruth.specification.clauses import PROMISES, SPECIFICATION, all_clauses

# The same examples on every machine and in every run, so that a change that passes here passes everywhere; a deadline
# would fail a test because the machine is busy.
settings.register_profile("fast", deadline=None, derandomize=True, max_examples=100)
# New examples in every run. Strategies that aim at rare cases discard many drafts, which is no fault in a long run.
settings.register_profile(
    "deep",
    deadline=None,
    max_examples=10_000,
    print_blob=True,
    suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow],
)
# For mutants it is enough that an example fails: it need not be the smallest. Tests that are not about the mutated file
# have fewer, since most of the time is spent on what they do not find.
WITHOUT_SHRINKING = (Phase.explicit, Phase.generate)
settings.register_profile("mutants", settings.get_profile("fast"), phases=WITHOUT_SHRINKING)
settings.register_profile("mutants-elsewhere", settings.get_profile("mutants"), max_examples=25)
settings.load_profile("fast")

# A shell that starts us in the background has us ignore interruptions, and so would all that the tests start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).parent.parent


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A test that names no clause, or one that does not exist, ends the run before it begins."""
    clauses = all_clauses(ROOT)
    for item in items:
        named = {clause for mark in item.iter_markers("clause") for clause in mark.args}
        if not named:
            raise pytest.UsageError(f'{item.nodeid} names no clause: mark it with @pytest.mark.clause("…").')
        if unknown := named - clauses:
            raise pytest.UsageError(
                f"{item.nodeid} names {min(unknown)}, which is no clause of {SPECIFICATION} or {PROMISES}."
            )
