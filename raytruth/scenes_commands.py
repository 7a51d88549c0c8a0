"""`raytruth scenes`: the library, and what can be done with a scene file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter

from raytruth.coverage_command import scenes_coverage
from raytruth.errors import UsageError
from raytruth.export_command import export
from raytruth.options import AsJson, open_scene
from raytruth.output import print_json, print_table, say, tell
from raytruth.scenes.library import library_names
from raytruth.scenes.light_paths import whitted_class
from raytruth.scenes.requirements import required_features
from raytruth.scenes.schema import json_schema

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

app = App(name="scenes")


@app.command(name="list")
def list_scenes(*, as_json: AsJson = False) -> None:
    """List the scenes of the library, each with what a renderer that gets it wrong has got wrong.

    Example: `raytruth scenes list --json`

    Parameters
    ----------
    as_json
        Print one JSON document instead of text.
    """
    summaries = [_summary(open_scene(name)) for name in library_names()]
    if as_json:
        print_json({"scenes": summaries})
        return
    print_table(
        ("Scene", "Size", "Convention", "Purpose", "Features"),
        [
            (
                summary["name"],
                f"{summary['width']}x{summary['height']}",
                summary["convention"],
                summary["purpose"],
                " ".join(feature.lower() for feature in summary["features"]),
            )
            for summary in summaries
        ],
    )


def _summary(scene: Scene) -> dict[str, Any]:
    return {
        "name": scene.name,
        "purpose": scene.purpose,
        "convention": scene.convention,
        "width": scene.camera.width,
        "height": scene.camera.height,
        "features": sorted(required_features(scene)),
        "light_paths": whitted_class(scene),
    }


@app.command
def show(
    scene: Annotated[str | None, Parameter(show_default=False)] = None,
    /,
    *,
    schema: Annotated[bool, Parameter(negative="")] = False,
    as_json: AsJson = False,
) -> None:
    """Show a scene: its JSON, and what it requires.

    Examples: `raytruth scenes show whitted-1980`, `raytruth scenes show --schema > scene.schema.json`

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    schema
        Print the JSON Schema that every scene file obeys; takes no scene.
    as_json
        Print one JSON document instead of text.
    """
    if schema:
        if scene is not None:
            raise UsageError("scenes show: --schema is the same for all scenes; leave the scene out.")
        print_json(json_schema())
        return
    if scene is None:
        raise UsageError("scenes show: expected a scene; see raytruth scenes list.")
    opened = open_scene(scene)
    text = opened.model_dump(mode="json", exclude_defaults=True, exclude={"name"})
    facts = {**_summary(opened), "max_depth": opened.max_depth, "primitives": _primitive_count(opened)}
    if as_json:
        print_json({**facts, "scene": text})
        return
    say(f"{opened.name}: {opened.purpose}")
    print(f"requires: {', '.join(feature.lower() for feature in facts['features'])}")
    print(f"light paths: {facts['light_paths']}")
    print(f"primitives: {facts['primitives']}")
    print_json(text)


def _primitive_count(scene: Scene) -> int:
    return sum(len(shape.faces) if shape.shape == "mesh" else 1 for shape in scene.objects)


@app.command
def validate(files: Annotated[tuple[str, ...], Parameter(consume_multiple=True)], /, *, as_json: AsJson = False) -> int:
    """Check scene files, and tell every problem of each. Exit status 2 if there is any.

    Example: `raytruth scenes validate mine.json yours.json`

    Parameters
    ----------
    files
        Paths of .json files, or scenes of the library.
    as_json
        Print one JSON document instead of text.
    """
    problems = {file: _problems(file) for file in files}
    if as_json:
        print_json(
            {"files": [{"file": file, "valid": not found, "problems": found} for file, found in problems.items()]}
        )
    else:
        for file, found in problems.items():
            if found:
                tell("\n".join(found))
            else:
                say(f"{file}: valid")
    return 2 if any(problems.values()) else 0


def _problems(file: str) -> list[str]:
    try:
        open_scene(file)
    except UsageError as error:
        return str(error).splitlines()
    return []


app.command(export)
app.command(scenes_coverage, name="coverage")
