"""JSON as people read it: a list of numbers on one line, everything that holds more on lines of its own."""

from __future__ import annotations

import json
from typing import Any


def json_text(value: Any) -> str:
    """JSON whose numbers read back as the same float64, in ASCII. Raises ValueError for what is not finite."""
    return _indented(value, "") + "\n"


def _indented(value: Any, margin: str) -> str:
    members = list(value.values() if isinstance(value, dict) else value) if isinstance(value, dict | list) else []
    if not any(isinstance(member, dict | list) for member in members):
        return json.dumps(value, allow_nan=False)
    inner = f"{margin}  "
    texts = [_indented(member, inner) for member in members]
    if isinstance(value, dict):
        texts = [f"{json.dumps(key)}: {text}" for key, text in zip(value, texts, strict=True)]
        return "{\n" + ",\n".join(inner + text for text in texts) + f"\n{margin}}}"
    return "[\n" + ",\n".join(inner + text for text in texts) + f"\n{margin}]"
