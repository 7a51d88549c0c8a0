"""The wheel, installed into an environment of its own, works from any folder."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

from raytruth.scenes.library import LIBRARY_FOLDER, library_names

pytestmark = pytest.mark.clause("PRJ-3")

ROOT = Path(__file__).parent.parent
FOLDERS = ("scenes", "reference_tracer", "comparisons", "reports", "specification")
"""What the package `raytruth` links to."""
PROJECT_FILES = ("pyproject.toml", "README.md", "LICENSE")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built from a copy, since building leaves files beside the source."""
    tree = tmp_path_factory.mktemp("tree")
    for folder in (*FOLDERS, "raytruth"):
        shutil.copytree(ROOT / folder, tree / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    for name in PROJECT_FILES:
        shutil.copy(ROOT / name, tree)
    run([sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", "dist", "."], tree)
    (built,) = (tree / "dist").glob("*.whl")
    return built


@pytest.fixture(scope="module")
def raytruth(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The command of an environment that holds the wheel; what the wheel needs is lent by the tests' environment."""
    folder = tmp_path_factory.mktemp("an environment")
    venv.create(folder, symlinks=True)
    site = Path(sysconfig.get_path("purelib", "venv", {"base": str(folder), "platbase": str(folder)}))
    command = [sys.executable, "-m", "pip", "--python", str(folder / "bin" / "python"), "install", "--quiet"]
    run([*command, "--no-deps", "--no-index", "--disable-pip-version-check", str(wheel)], folder)
    # A path in a .pth file comes after the environment's own packages, and its own .pth files are not read: what is
    # installed for editing there stays out.
    (site / "lent.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    return folder / "bin" / "raytruth"


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """The folder of somebody whose own packages are called like our folders, and break whoever imports them."""
    for package in (*FOLDERS, "tests", "benchmarks"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text("raise RuntimeError('imported from the working directory')")
    return tmp_path


def run(command: list[str], folder: Path) -> str:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    finished = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stdout + finished.stderr
    return finished.stdout


def test_the_wheel_holds_the_packages_with_their_data_and_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        licenses = [name for name in archive.namelist() if name.endswith("LICENSE")]
    expected = {
        f"raytruth/{path.relative_to(ROOT).as_posix()}".replace("raytruth/raytruth/", "raytruth/")
        for folder in (*FOLDERS, "raytruth")
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert names == expected
    assert len(licenses) == 1


def test_the_wheel_installs_one_package(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        top = {name.split("/")[0] for name in archive.namelist()}
    assert {name for name in top if not name.endswith(".dist-info")} == {"raytruth"}


def test_the_links_of_the_package_lead_to_the_folders_beside_it() -> None:
    links = {path.name: path.readlink() for path in (ROOT / "raytruth").iterdir() if path.is_symlink()}
    assert links == {folder: Path("..") / folder for folder in FOLDERS}


def test_the_installed_code_is_the_wheels_own(raytruth: Path, elsewhere: Path) -> None:
    code = "from raytruth import scenes, reports; print(scenes.__file__, reports.__file__, sep='\\n')"
    for file in run([str(raytruth.with_name("python")), "-c", code], elsewhere).splitlines():
        assert Path(file).is_relative_to(raytruth.parent.parent)


def test_the_package_runs_as_a_module_from_any_folder(raytruth: Path, elsewhere: Path) -> None:
    listed = run([str(raytruth.with_name("python")), "-m", "raytruth", "scenes", "list"], elsewhere)
    assert [name for name in library_names() if name not in listed] == []


def test_the_scene_library_travels_along(raytruth: Path, elsewhere: Path) -> None:
    listed = run([str(raytruth), "scenes", "list"], elsewhere)
    assert len(list(LIBRARY_FOLDER.glob("*.json"))) == len(library_names()) > 0
    assert [name for name in library_names() if name not in listed] == []


def test_a_scene_is_rendered_from_any_folder(raytruth: Path, elsewhere: Path) -> None:
    run([str(raytruth), "render", "single-sphere", "-o", "sphere.exr", "--size", "8x8"], elsewhere)
    assert (elsewhere / "sphere.exr").stat().st_size > 0


def test_the_matrix_runs_and_reports_from_any_folder(raytruth: Path, elsewhere: Path) -> None:
    # Among them renderers that run in workers of their own.
    renderers = "closed_form,mitsuba,embree,raytruth"
    run([str(raytruth), "run", "single-triangle", "--renderer", renderers, "--out", "results"], elsewhere)
    assert (elsewhere / "results" / "results.json").is_file()
    assert list((elsewhere / "results").glob("*.html"))
