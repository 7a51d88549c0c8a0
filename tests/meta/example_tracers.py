"""The example tracers as tests need them: a copy of their folder, in which each is built when it is first needed."""

from __future__ import annotations

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


def is_here(language: str) -> bool:
    """Whether the tracer in this language can be built and run: compilers are no part of raytruth's environment."""
    return shutil.which(TOOLS[language]) is not None


def needs(language: str) -> pytest.MarkDecorator:
    """Leaves a test out where the toolchain is missing, and says so."""
    return pytest.mark.skipif(not is_here(language), reason=f"{TOOLS[language]} is not installed")


LANGUAGES = [pytest.param(language, marks=needs(language)) for language in TOOLS]


@pytest.fixture(scope="module")
def copies(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a copy of all tracers, each of which is built when it is first needed."""
    return Path(shutil.copytree(TRACERS, tmp_path_factory.mktemp("copies") / "tracers"))


@cache
def built(copies: Path, language: str) -> dict[str, Any]:
    """What the tracer declares, once it is built."""
    subprocess.run(["make", "-C", str(copies), language], check=True, capture_output=True)
    return tomllib.loads((copies / language / "tracer.toml").read_text(encoding="utf-8"))
