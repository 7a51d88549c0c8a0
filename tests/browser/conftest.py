import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from raytruth.reports.html import write_html_report
from tests.browser.static_server import StaticServer
from tests.browser.viewing import FAILING, cell_page, ready
from tests.reports.sample_results import write_sample

NAMES = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = [
    "--no-sandbox",  # containers run as root
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The system's Chromium; a machine without it fails these tests rather than passing unlooked."""
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        pytest.fail(f"none of {', '.join(NAMES)} is installed: apt install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def browser_with_webgl(browser: Browser) -> Iterator[Browser]:
    """The same with WebGL in software; headless Chromium has none without being told."""
    arguments = [argument for argument in ARGUMENTS if argument != "--disable-gpu"]
    software = ["--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader"]
    path = next(filter(None, map(shutil.which, NAMES)))
    started = browser.browser_type.launch(executable_path=path, args=[*arguments, *software])
    yield started
    started.close()


def is_complaint(text: str) -> bool:
    """Software that stands in for a graphics processor says of itself that it is slow."""
    return "GL Driver Message" not in text


@dataclass
class Visit:
    """A page with what happened while it was open."""

    page: Page
    requests: list[str]
    complaints: list[str]


@pytest.fixture(scope="session")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_html_report(write_sample(tmp_path_factory.mktemp("browser") / "results"))


@pytest.fixture
def contexts() -> Iterator[list[BrowserContext]]:
    opened: list[BrowserContext] = []
    yield opened
    for context in opened:
        context.close()


@pytest.fixture
def visit(browser: Browser, report: Path, contexts: list[BrowserContext]) -> Any:
    def open_page(
        width: int = 1600,
        path: Path = report,
        *,
        address: str | None = None,
        after: str = "",
        by: Browser = browser,
        **options: Any,
    ) -> Visit:
        """Visit a file, or the address if there is one; `after` is put behind either."""
        is_offline = address is None
        context = by.new_context(viewport={"width": width, "height": 900}, offline=is_offline, **options)
        contexts.append(context)
        page = context.new_page()
        visit = Visit(page, [], [])
        page.on("request", lambda request: visit.requests.append(request.url))
        page.on(
            "console", lambda message: visit.complaints.append(message.text) if is_complaint(message.text) else None
        )
        page.on("pageerror", lambda error: visit.complaints.append(str(error)))
        page.goto((address or path.as_uri()) + after)
        return visit

    return open_page


@pytest.fixture
def served(report: Path) -> Iterator[Any]:
    """Serves the report with headers of the caller's choice, and gives the address of its folder."""
    servers: list[StaticServer] = []

    def serve(**headers: str) -> str:
        servers.append(StaticServer(report.parent, headers))
        return servers[-1].address

    yield serve
    for server in servers:
        server.close()


@pytest.fixture
def opened(visit: Any, report: Path) -> Any:
    """Opens the page of a cell in English, and waits for its viewer."""

    def open_cell(name: str = FAILING, **options: Any) -> Page:
        return ready(visit(path=cell_page(report, name), **{"locale": "en-GB", **options}).page)

    return open_cell
