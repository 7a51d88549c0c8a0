from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.matrix import kept_versions
from raytruth.comparisons.matrix.kept_versions import kept_version, tried_version
from tests.comparisons.matrix.pretending import Pretender

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("RES-3")


@pytest.fixture(autouse=True)
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setattr(kept_versions, "cache_folder", lambda: folder)
    return folder


def test_what_a_trial_told_is_kept_without_another_trial() -> None:
    renderer = Pretender()
    assert kept_version(renderer) is None
    assert tried_version(renderer) == "pretender 1"
    assert kept_version(renderer) == "pretender 1"
    assert renderer.trials == 1
    assert kept_version(Pretender(name="another")) is None


def test_that_it_is_missing_is_not_kept() -> None:
    """It may have failed by chance, and what was kept before is no longer true."""
    tried_version(Pretender())
    assert tried_version(Pretender(installed=None)) is None
    assert kept_version(Pretender()) is None


@pytest.mark.parametrize("text", ["", "\n", "one line", "one\ntwo\nthree\n", "\xff"])
def test_a_file_that_is_not_ours_is_as_none(cache: Path, text: str) -> None:
    tried_version(Pretender())
    (file,) = (cache / "versions").iterdir()
    file.write_text(text, encoding="latin-1")
    assert kept_version(Pretender()) is None


def test_a_package_that_is_installed_removed_or_made_anew_calls_for_a_trial(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    tried_version(Pretender())
    package = tmp_path / "renderer-2.0.dist-info"
    package.mkdir()
    assert kept_version(Pretender()) is None
    tried_version(Pretender())
    assert kept_version(Pretender()) is not None
    os.utime(package, ns=(0, 0))
    assert kept_version(Pretender()) is None
    tried_version(Pretender())
    package.rmdir()
    assert kept_version(Pretender()) is None


def test_a_change_of_the_systems_libraries_calls_for_a_trial(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    libraries = tmp_path / "ld.so.cache"
    libraries.write_text("some")
    monkeypatch.setattr(kept_versions, "SYSTEM_FILES", (str(libraries), str(tmp_path / "of another distribution")))
    tried_version(Pretender())
    assert kept_version(Pretender()) is not None
    libraries.write_text("some more")
    assert kept_version(Pretender()) is None


def test_a_change_of_the_program_calls_for_a_trial(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    program = tmp_path / "pretender"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    tried_version(Pretender())
    monkeypatch.setenv("PATH", str(tmp_path))
    assert kept_version(Pretender()) is None


@pytest.mark.parametrize("name", ["LD_LIBRARY_PATH", "DRJIT_LIBLLVM_PATH", "GALLIUM_DRIVER"])
def test_what_steers_libraries_calls_for_a_trial(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    tried_version(Pretender())
    monkeypatch.setenv("SHLVL", "7")
    assert kept_version(Pretender()) is not None
    monkeypatch.setenv(name, "/elsewhere")
    assert kept_version(Pretender()) is None


def test_a_change_of_our_code_calls_for_a_trial(monkeypatch: pytest.MonkeyPatch) -> None:
    tried_version(Pretender())
    for name in ("source_digest", "adapter_digest"):
        with monkeypatch.context() as changed:
            changed.setattr(kept_versions, name, lambda *_: "another")
            assert kept_version(Pretender()) is None
    assert kept_version(Pretender()) is not None
