from __future__ import annotations

from pathlib import Path

import pytest

from raytruth.comparisons.sandboxes.sandbox import kept_environment

pytestmark = pytest.mark.clause("SBX-3")


def test_no_variable_of_ours_reaches_a_submission_but_those_that_programs_need() -> None:
    ours = {"PATH": "/bin", "LANG": "C.UTF-8", "GITHUB_TOKEN": "secret", "RAYTRUTH_CACHE": "/truth", "HOME": "/root"}
    assert kept_environment(ours, Path("/work")) == {"PATH": "/bin", "LANG": "C.UTF-8", "HOME": "/work"}
