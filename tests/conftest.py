"""Profiles for hypothesis: `fast` unless `--hypothesis-profile=deep` is given."""

from __future__ import annotations

from hypothesis import HealthCheck, settings

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
settings.load_profile("fast")
