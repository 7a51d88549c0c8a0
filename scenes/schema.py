"""The JSON Schema of scene files, for editors and for other programs."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.consistency import LARGEST_PIXEL_COUNT, SMALLEST_SINE
from raytruth.scenes.loading import LARGEST_SCENE_FILE, MOST_MESH_FILES
from raytruth.scenes.mesh_files import LARGEST_MESH_FILE
from raytruth.scenes.scene import Scene
from raytruth.scenes.triangle_lists import LARGEST_FACE_COUNT

_MESH_FILE = {"required": ["shape", "file"], "properties": {"shape": {"const": "mesh"}, "file": {"type": "string"}}}

# Limits that no keyword of JSON Schema states, by definition and key; editors show them.
_CAMERA_LIMITS = {
    "up": f"Not parallel to the view: the sine of the angle between them is above {SMALLEST_SINE:g}.",
    "width": f"At most {LARGEST_PIXEL_COUNT} pixels in all: width times height.",
    "height": f"At most {LARGEST_PIXEL_COUNT} pixels in all: width times height.",
}
_FILE_LIMITS = {"file": f"An OBJ or PLY file in the scene's folder or below it, of at most {LARGEST_MESH_FILE} bytes."}
_LIMITS = {"PerspectiveCamera": _CAMERA_LIMITS, "OrthographicCamera": _CAMERA_LIMITS, "Mesh": _FILE_LIMITS}


def json_schema() -> dict[str, Any]:
    """The schema (draft 2020-12) that a scene file obeys; loading checks more than a schema can say."""
    schema = Scene.model_json_schema()
    # The name comes from the file's name, so the file must not state it.
    del schema["properties"]["name"]
    schema["description"] += f" A file has at most {LARGEST_SCENE_FILE} bytes."
    schema["properties"]["objects"] |= {
        "description": f"At most {LARGEST_FACE_COUNT} triangles in all meshes, and {MOST_MESH_FILES} mesh files.",
        "contains": _MESH_FILE,
        "minContains": 0,
        "maxContains": MOST_MESH_FILES,
    }
    for definition, limits in _LIMITS.items():
        for key, limit in limits.items():
            schema["$defs"][definition]["properties"][key]["description"] = limit
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:raytruth:scene:1",
        **schema,
        "title": "raytruth scene",
    }
