"""The plugin for pytest: a user's program, judged in one test a cell (docs/your-renderer.md).

pytest loads it into every run of whoever has raytruth installed, and so it imports nothing until it is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options, all of which begin alike."""
    group = parser.getgroup("raytruth", "judge a ray tracer by raytruth, in one test a scene")
    group.addoption(
        "--raytruth-command",
        action="append",
        default=[],
        metavar="[NAME=]COMMAND",
        help="the program, as in './tracer {scene} {output}'; may be given several times",
    )
    group.addoption(
        "--raytruth-file",
        action="append",
        default=[],
        metavar="FILE",
        help="the program as a TOML file declares it; may be given several times",
    )
    group.addoption(
        "--raytruth-scene",
        action="append",
        default=[],
        metavar="SCENE",
        help="a scene of the library or a scene file, the whole library by default; may be given several times",
    )
    group.addoption("--raytruth-quick", action="store_true", help="only the quick suite: few scenes with small images")
    group.addoption("--raytruth-strict", action="store_true", help="what is as declared, not as due, fails")
    group.addoption("--raytruth-waivers", metavar="FILE", help="known failures, which are expected to fail")
    group.addoption("--raytruth-out", default="results", metavar="DIR", help="the results directory (default: results)")


def pytest_configure(config: pytest.Config) -> None:
    """Where a program is given, have its cells collected."""
    if config.getoption("raytruth_command") or config.getoption("raytruth_file"):
        from raytruth.cells_as_tests import CellPlugin  # noqa: PLC0415 - all other runs of pytest do without

        config.addinivalue_line("markers", "raytruth: judges a scene as a user's program renders it")
        config.pluginmanager.register(CellPlugin(config), "raytruth-cells")
