"""What compiled functions can ask that their arguments do not say: the answer to a comparison that numbers leave open.

Numbers that are pairs of floats may overlap, and a comparison of them then has no answer of their own. A function that
compares asks `undecided`. The answer takes a branch, any, and the call is marked: what it computes from there on is one
of several things that might be. Who called learns of it by `marks_taken`.
"""

from __future__ import annotations


class UndecidedError(Exception):
    """In interpreted code: a comparison has no answer."""


def undecided() -> bool:
    """The answer to a comparison that its operands leave open: True in compiled code, which is marked for it."""
    raise UndecidedError


def marks_taken() -> int:
    """In compiled code: which marks have been set since this was asked last, 0 for none; it takes them away."""
    return 0


STACK_IS_FULL = 1
"""A mark: an element was put on a stack that has no room for it, and is lost."""
UNDECIDED = 2
"""A mark: a comparison was undecided, and an answer was taken all the same."""
