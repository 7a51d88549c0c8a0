"""Any static server, with headers of the test's choice."""

from __future__ import annotations

from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

JENKINS = {"Content-Security-Policy": "sandbox; default-src 'none'; img-src 'self'; style-src 'self'"}
"""How Jenkins serves what builds leave: no script runs, and the page has an origin of its own."""


class _Handler(SimpleHTTPRequestHandler):
    def __init__(self, *arguments: object, headers: dict[str, str], directory: str) -> None:
        self.more_headers = headers
        super().__init__(*arguments, directory=directory)  # type: ignore[arg-type] # what the server gives

    def end_headers(self) -> None:
        for name, value in self.more_headers.items():
            self.send_header(name, value)
        super().end_headers()

    def log_message(self, *_: object) -> None:
        """Say nothing."""


class StaticServer:
    """Serves a folder on this machine until it is closed."""

    def __init__(self, folder: Path, headers: dict[str, str]) -> None:
        handler = partial(_Handler, headers=headers, directory=str(folder))
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self.thread = Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()
        self.address = f"http://127.0.0.1:{self.server.server_port}/"

    def close(self) -> None:
        self.server.shutdown()
        self.server.server_close()
        self.thread.join()
