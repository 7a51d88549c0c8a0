"""How commands print: JSON for programs, tables on a terminal, plain lines elsewhere, progress on standard error."""

from __future__ import annotations

import json
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from raytruth.reports.wording import printable

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


def print_json(document: Any) -> None:
    """One document on standard output; nothing else may be printed there."""
    print(json.dumps(document, indent=2, allow_nan=False))


def say(text: str) -> None:
    """A text on standard output at once; names in it may hold control characters, which are shown as marks."""
    print(printable(text), flush=True)


def tell(text: str) -> None:
    """As `say`, on standard error."""
    print(printable(text), file=sys.stderr, flush=True)


def print_table(headers: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """A table on a terminal; elsewhere one line a row with tabs between the cells, made to be searched and cut."""
    console = Console()
    if not console.is_terminal:
        for row in rows:
            print("\t".join(map(printable, row)))
        return
    table = Table(*headers, box=None, padding=(0, 2, 0, 0))
    for row in rows:
        table.add_row(*(Text(printable(cell)) for cell in row))
    console.print(table)


@contextmanager
def progress(task: str) -> Iterator[None]:
    """Say what is being done while it takes long: a running sign on a terminal, a plain line elsewhere."""
    console = Console(stderr=True)
    if console.is_terminal:
        with console.status(Text(printable(f"{task} …"))):
            yield
    else:
        tell(f"{task} …")
        yield
