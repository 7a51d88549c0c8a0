"""The JSON Schema of declarations, for editors, which also read it for TOML files."""

from __future__ import annotations

from typing import Any

from raytruth.comparisons.renderers.program.declaration import Declaration


def json_schema() -> dict[str, Any]:
    """The schema (draft 2020-12) that a declaration obeys; loading checks more than a schema can say."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:raytruth:renderer:1",
        **Declaration.model_json_schema(),
        "title": "raytruth renderer",
    }
