"""Data inside of HTML and scripts: the one place where untrusted text becomes part of what a browser parses as code."""

from __future__ import annotations

import json


def script_json(value: object) -> str:
    """The value as JSON that may stand in a script, or in an element of HTML that holds data.

    `<`, `>` and `&` end or begin markup there, and two line separators of Unicode once ended lines of JavaScript: all
    of them are written as escapes. Raises ValueError for what is not a finite number, since JSON has none.
    """
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))  # other than ASCII is escaped
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
