"""`raytruth oracle`."""

from __future__ import annotations

import sys
from typing import Annotated

from cyclopts import Parameter

from raytruth.comparisons.oracle.lines import answered_lines, json_schema
from raytruth.output import print_json

BAD_INPUT = 2


def oracle(*, schema: Annotated[bool, Parameter(negative="")] = False) -> int:
    """Answer single steps of a ray tracer, proven, for unit tests in any language: lines of JSON in and out.

    Each line of standard input is a question, each line of standard output its answer, written at once: what is true,
    and all that a program may give that computes in float32 or float64. Numbers are JSON's, or texts as C's %a
    writes them. A line that is no good question is answered with a sentence, and the next one is read.

    Parameters
    ----------
    schema
        Print the JSON Schemas of questions and answers, and nothing else.
    """
    if schema:
        print_json(json_schema())
        return 0
    all_good = True
    for line, is_good in answered_lines(sys.stdin.buffer):
        print(line, flush=True)
        all_good = all_good and is_good
    return 0 if all_good else BAD_INPUT
