"""`raytruth renderers`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from comparisons.renderers.catalogue import UnknownRendererError, select_renderers
from raytruth.errors import UsageError
from raytruth.options import AsJson  # noqa: TC001 - cyclopts reads annotations at run time
from raytruth.output import print_json, print_table, progress

if TYPE_CHECKING:
    from comparisons.renderer import Renderer


def renderers(*names: str, as_json: AsJson = False) -> None:
    """Show who can render here, what each can do, and how to install the rest.

    Parameters
    ----------
    names
        Only these renderers; all of them by default.
    as_json
        Print one JSON document instead of text.
    """
    try:
        selected = select_renderers(names)
    except UnknownRendererError as error:
        raise UsageError(str(error)) from error
    records = []
    for name, renderer in selected.items():
        with progress(f"Trying {name}"):
            records.append(_record(renderer))
    if as_json:
        print_json({"renderers": records})
        return
    print_table(
        ("Renderer", "Version", "Integrators and their light paths", "Error model", "Install"),
        [
            (
                record["name"],
                record["version"] or "missing",
                "; ".join(f"{name} {paths}" for name, paths in record["integrators"].items()),
                "; ".join(f"{subject}: {clause}" for subject, clause in record["error_model"].items()),
                record["install"],
            )
            for record in records
        ],
    )


def _record(renderer: Renderer) -> dict[str, Any]:
    version = renderer.version()
    return {
        "name": renderer.name,
        "version": version,
        "available": version is not None,
        "integrators": {
            # A limit of `depth` bounces reads as a letter, as in {0,n}.
            integrator.name: integrator.light_paths.format(depth="n")
            if integrator.has_depth
            else integrator.light_paths
            for integrator in renderer.integrators
        },
        "error_model": renderer.error_model.in_words(),
        "install": renderer.install,
    }
