"""`raytruth explain`."""

from __future__ import annotations

import json
from typing import Annotated

from cyclopts import Parameter

from raytruth.api import images
from raytruth.errors import UsageError
from raytruth.options import AsJson, open_scene, parse_pixel
from raytruth.output import print_json
from raytruth.reference_tracer.explanation import ExplanationError
from raytruth.reports.explanation_text import explanation_text


def explain(
    scene: str,
    /,
    *,
    pixel: Annotated[str, Parameter(allow_leading_hyphen=True)],
    hexadecimal: Annotated[bool, Parameter(name="--hex", negative="")] = False,
    as_json: AsJson = False,
) -> None:
    """Explain one pixel: every ray of its tree, every hit, normal, term and weight, and the sum.

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    pixel
        X,Y: column from the left, row from the top, both from 0.
    hexadecimal
        Print numbers as hexadecimal floats, which are exact; those of --json always are.
    as_json
        Print one JSON document instead of text.
    """
    x, y = parse_pixel(pixel)
    try:
        tree = images.explain(open_scene(scene), x, y)
    except ExplanationError as error:
        raise UsageError(str(error)) from error
    if as_json:
        print_json(json.loads(tree.model_dump_json()))
    else:
        print(explanation_text(tree, hexadecimal), end="")
