"""The JSON Schema of scene files, for editors and for other programs."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.scene import Scene


def json_schema() -> dict[str, Any]:
    """The schema (draft 2020-12) that a scene file obeys; loading checks more than a schema can say."""
    schema = Scene.model_json_schema()
    # The name comes from the file's name, so the file must not state it.
    del schema["properties"]["name"]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:raytruth:scene:1",
        **schema,
        "title": "raytruth scene",
    }
