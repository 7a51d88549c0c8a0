"""`raytruth renderers`."""

from __future__ import annotations

import tomllib
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter
from rich.console import Console
from rich.padding import Padding
from rich.text import Text

from raytruth.comparisons.error_models.formulas import FORMULAS
from raytruth.comparisons.renderers.catalogue import (
    UnknownRendererError,
    all_renderers,
    select_renderers,
    unusable_adapters,
)
from raytruth.comparisons.renderers.program.declaration_file import DeclarationError, checked_declaration
from raytruth.comparisons.renderers.program.declaration_schema import json_schema
from raytruth.comparisons.renderers.program.declared_model import formula_in_file
from raytruth.comparisons.renderers.program.starting_file import starting_text
from raytruth.comparisons.renderers.protocol import shown_error_model, versions_in_words, why_unavailable
from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - cyclopts reads annotations at run time
from raytruth.output import print_json, progress, say, tell
from raytruth.probe_command import tell_tightest_declaration
from raytruth.programs import programs_of
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.renderers.protocol import Renderer


def renderers(
    *names: str,
    renderer_file: Annotated[tuple[Path, ...], Parameter(negative="")] = (),
    init: Annotated[str | None, Parameter(show_default=False)] = None,
    schema: Annotated[bool, Parameter(negative="")] = False,
    formulas: Annotated[bool, Parameter(negative="")] = False,
    probe: Annotated[Path | None, Parameter(show_default=False)] = None,
    as_json: AsJson = False,
) -> int:
    """Show who can render here, what each can do, and how to install the rest.

    Parameters
    ----------
    names
        Only these renderers; all of them by default.
    renderer_file
        Also a program of your own, as this TOML file declares it.
    init
        Write NAME.toml, a commented file that declares a program of your own of this name, and nothing else.
    schema
        Print the JSON Schema that such files obey, and nothing else.
    formulas
        List the formulas that a renderer can declare, with a line of code each, and nothing else.
    probe
        Render the quick suite with the program that this TOML file declares, and tell the tightest declaration of bits
        and ray offset under which it passes, with the pixel that decides; nothing else.
    as_json
        Print one JSON document instead of text.
    """
    if schema:
        print_json(json_schema())
    elif formulas:
        _print_formulas(as_json=as_json)
    elif init is not None:
        say(f"Wrote {_start(init)}; edit it, then: raytruth run --quick --renderer-file {init}.toml")
    elif probe is not None:
        return tell_tightest_declaration(probe, as_json=as_json)
    else:
        _show(names, renderer_file, as_json=as_json)
    return 0


def _show(names: Sequence[str], renderer_file: Sequence[Path], *, as_json: bool) -> None:
    for sentence in unusable_adapters():
        tell(f"raytruth: {sentence}")
    programs = programs_of((), renderer_file)
    try:
        selected = (select_renderers(names) if names or not programs else {}) | programs
    except UnknownRendererError as error:
        raise UsageError(str(error)) from error
    records = []
    for name, renderer in selected.items():
        with progress(f"Trying {name}"):
            records.append(_record(renderer))
    if as_json:
        print_json({"renderers": records})
        return
    console = Console()
    for record in records:
        if console.is_terminal:
            _print_block(console, record)
        else:
            print("\t".join((record["name"], *_clauses(record).values())))


def _start(name: str) -> Path:
    """The file to start from. Raises UsageError where the name will not do, or where there is such a file."""
    path = Path(f"{name}.toml")
    try:
        checked_declaration(tomllib.loads(starting_text(name)), "--init")
    except tomllib.TOMLDecodeError as error:
        raise UsageError(
            f"--init: expected a name of lower-case letters, digits and hyphens, found {name!a}."
        ) from error
    except DeclarationError as error:
        raise UsageError(str(error)) from error
    if name in all_renderers():
        raise UsageError(f"--init: {name} is one of raytruth's own renderers; choose another name.")
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(starting_text(name))
    except FileExistsError as error:
        raise UsageError(f"--init: {path} is there already; it is left as it is.") from error
    return path


def _print_formulas(*, as_json: bool) -> None:
    """As they are stated under [formulas] in a file, with their fields of an error model in JSON."""
    stated = [(formula, formula_in_file(formula)) for formula in FORMULAS]
    if as_json:
        print_json({"formulas": [{**asdict(it), "in_file": dict([line]) if line else None} for it, line in stated]})
        return
    lines = [(f'{line[0]} = "{line[1]}"', formula.code) for formula, line in stated if line]
    width = max(len(line) for line, _ in lines)
    for line, code in lines:
        print(f"{line:{width}}  {code}")


def _clauses(record: dict[str, Any]) -> dict[str, str]:
    """What is told of a renderer, by its heading."""
    return {
        "version": record["version"] or "missing",
        "derived for": record["derived_for"],
        "light paths": "; ".join(f"{name} {paths}" for name, paths in record["integrators"].items()),
        "expresses": f"{record['scenes']} library scenes; {', '.join(record['features'])}",
        "error model": "; ".join(f"{subject}: {clause}" for subject, clause in record["error_model"].items()),
        "install": record["install"],
    }


def _print_block(console: Console, record: dict[str, Any]) -> None:
    """Under the renderer's name a line for each clause, which breaks between words."""
    console.print(Text(record["name"], style="bold"))
    for heading, clause in _clauses(record).items():
        is_long = heading == "error model"
        console.print(Padding(Text(f"{heading}:" if is_long else f"{heading}: {clause}"), (0, 0, 0, 2)))
        for subject, part in record["error_model"].items() if is_long else ():
            console.print(Padding(Text(f"{subject}: {part}"), (0, 0, 0, 4)))
    console.print()


def _record(renderer: Renderer) -> dict[str, Any]:
    version = renderer.version()
    expressible = [scene for scene in map(open_scene, library_names()) if renderer.refuses(scene) is None]
    features = frozenset[str]().union(*map(required_features, expressible))
    return {
        "name": renderer.name,
        "version": version,
        "available": why_unavailable(renderer, version) is None,
        "derived_for": versions_in_words(renderer),
        "integrators": {
            # A limit of `depth` bounces reads as a letter, as in {0,n}.
            integrator.name: integrator.light_paths.format(depth="n")
            if integrator.has_depth
            else integrator.light_paths
            for integrator in renderer.integrators
        },
        # It refuses every scene with a feature that it lacks: those of the others are what it can express.
        "scenes": len(expressible),
        "features": sorted(feature.lower().replace("_", " ") for feature in features),
        "error_model": shown_error_model(renderer, version).in_words(),
        "install": renderer.install,
    }
