from __future__ import annotations

import sys
from pathlib import Path

import pytest

from raytruth.comparisons.sandboxes.visible_paths import installation_of, installed, own_files, without_hidden

pytestmark = pytest.mark.clause("SBX-3")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home folder with a space in its name."""
    folder = tmp_path / "a home"
    folder.mkdir()
    monkeypatch.setenv("HOME", str(folder))
    return folder


def file(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
    return path


def test_a_program_sees_the_folder_that_its_files_lie_in_and_nothing_of_the_system_twice(home: Path) -> None:
    tracer = file(home / "anna" / "tracer.py")
    assert own_files([tracer, Path("/usr/bin/env"), file(home / "anna" / "scene.py")]) == (home / "anna",)


def test_of_a_program_in_the_home_folder_itself_only_its_files_are_seen(home: Path) -> None:
    assert own_files([file(home / "tracer")]) == (home / "tracer",)
    assert own_files([file(home.parent / "tracer")]) == (home.parent / "tracer",)


def test_what_is_hidden_is_taken_out_of_what_is_visible(home: Path) -> None:
    course = home / "course"
    tracer, helper = file(course / "tracer"), file(course / "deep" / "helper")
    rubric, results = file(course / "rubric.toml"), file(course / "deep" / "results" / "grade.json")
    visible = without_hidden([course], [rubric, results.parent, home / "elsewhere"])
    assert set(visible) == {tracer, helper}
    assert without_hidden([course], []) == (course,)
    assert without_hidden([course], [course]) == ()
    assert without_hidden([course], [home]) == (course,)


def test_a_link_does_not_show_what_is_hidden(home: Path) -> None:
    rubric = file(home / "rubric.toml")
    (home / "anna").mkdir()
    (home / "anna" / "link").symlink_to(rubric)
    (home / "whole").symlink_to(home)
    assert without_hidden([home / "anna" / "link"], [rubric]) == ()
    assert rubric not in [path.resolve() for path in without_hidden([home / "whole"], [rubric])]


def test_folders_of_the_path_that_we_may_not_look_into_are_passed_over(home: Path) -> None:
    """Root may look into all; what matters to others is that there is no error."""
    file(home / "closed" / "tools" / "bin" / "tool")
    (home / "closed").chmod(0)
    try:
        found = installed(str(home / "closed" / "tools" / "bin"))
    finally:
        (home / "closed").chmod(0o700)
    assert set(found) - set(installed("")) <= {home / "closed" / "tools"}


def test_programs_on_the_path_are_seen_with_what_belongs_to_them(home: Path, tmp_path: Path) -> None:
    file(tmp_path / "tools" / "bin" / "tool")
    file(home / ".cargo" / "bin" / "rustc")
    file(home / ".cargo" / "credentials.toml")
    file(home / ".local" / "bin" / "mine")
    file(home / ".local" / "share" / "mail")
    file(home / "versions" / "3" / "bin" / "python").chmod(0o755)
    (home / ".local" / "bin" / "python").symlink_to(home / "versions" / "3" / "bin" / "python")
    folders = [tmp_path / "tools" / "bin", home / ".cargo" / "bin", home / ".local" / "bin", Path("/usr/bin")]
    found = set(installed(":".join(map(str, [*folders, "relative", home / "missing"]))))
    expected = {tmp_path / "tools", home / ".cargo" / "bin", home / ".local" / "bin", home / "versions" / "3"}
    assert found - set(installed("")) == expected
    ours = {Path(sys.prefix), Path(sys.base_prefix)}
    assert set(installed("")) == {path for path in ours if not path.resolve().is_relative_to("/usr")}


def test_a_program_of_the_path_that_is_a_link_is_seen_with_what_it_leads_to(home: Path) -> None:
    java = file(home.parent / "opt" / "jdk" / "bin" / "java")
    (home / "links").mkdir()
    (home / "links" / "java").symlink_to(java)
    assert installation_of(home / "links" / "java", f"/usr/bin:{home / 'links'}") == (home.parent / "opt" / "jdk",)
    assert installation_of(home / "links" / "java", "/usr/bin") == ()
    assert installation_of(Path("/usr/bin/env"), "/usr/bin") == ()
