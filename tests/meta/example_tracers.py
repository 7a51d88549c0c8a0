"""The example tracers as tests need them: a copy of their folder, in which each is built when it is first needed."""

from __future__ import annotations

import os
import shutil
import subprocess
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
TRACERS = ROOT / "examples" / "tracers"
TOOLS = {"cpp": "g++", "python": "python3", "javascript": "node", "java": "javac", "go": "go", "rust": "rustc"}
# Set where all that can be tested has to be (.ci/run). Then a toolchain that is missing fails its tests.
REQUIRE_ALL = bool(os.environ.get("RAYTRUTH_REQUIRE_ALL"))


def is_here(language: str) -> bool:
    """Whether the tracer in this language is to be tested."""
    return REQUIRE_ALL or shutil.which(TOOLS[language]) is not None


def _absent(language: str) -> pytest.MarkDecorator:
    return pytest.mark.skipif(not is_here(language), reason=f"{TOOLS[language]} is not installed")


LANGUAGES = [pytest.param(language, marks=_absent(language)) for language in TOOLS]


@pytest.fixture(scope="module")
def copies(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a copy of all tracers, each of which is built when it is first needed."""
    return Path(shutil.copytree(TRACERS, tmp_path_factory.mktemp("copies") / "tracers"))


@cache
def built(copies: Path, language: str) -> dict[str, Any]:
    """What the tracer declares, once it is built."""
    assert shutil.which(TOOLS[language]), f"{TOOLS[language]} is not installed, and RAYTRUTH_REQUIRE_ALL is set"
    subprocess.run(["make", "-C", str(copies), language], check=True, capture_output=True)
    return tomllib.loads((copies / language / "tracer.toml").read_text(encoding="utf-8"))
