"""What an adapter from elsewhere has to give, beside what types say."""

from __future__ import annotations

import pickle
import re
from typing import Any

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.renderers.protocol import Integrator, Renderer

MEMBERS = tuple(name for name in vars(Renderer) if not name.startswith("_"))
"""All that the protocol Renderer names."""

# Names are parts of paths and of commands.
_NAME = re.compile(r"[a-z][a-z0-9_-]{0,39}")
_HOW = "lower-case letters, digits, hyphens and underscores, at most 40, the first of them a letter"


def what_is_wrong(renderer: Any) -> str | None:
    """Why an object cannot be used as a renderer, in a clause; None if it obeys the protocol as far as one can see.

    Whatever its members raise is raised.
    """
    lacking = [name for name in MEMBERS if not hasattr(renderer, name)]
    if lacking:
        return f"it lacks what the protocol Renderer asks for: {', '.join(lacking)}"
    for name in ("version", "refuses", "is_stochastic", "render"):
        if not callable(getattr(renderer, name)):
            return f"its {name} is expected to be a method"
    if not _are(renderer.integrators, Integrator):
        return "its integrators are expected to be a tuple of Integrator, at least one"
    for name in (renderer.name, *(integrator.name for integrator in renderer.integrators)):
        if not isinstance(name, str) or _NAME.fullmatch(name) is None:
            return f"names of a renderer and its integrators are expected to be of {_HOW}, found {name!a}"
    models = renderer.error_models
    if not _are(models, tuple) or not all(len(pair) == 2 and isinstance(pair[1], ErrorModel) for pair in models):
        return "its error_models are expected to be a tuple of pairs: a pattern of versions, and an ErrorModel"
    pickle.loads(pickle.dumps(renderer))  # it travels to other processes
    return None


def _are(values: Any, kind: type) -> bool:
    return isinstance(values, tuple) and len(values) > 0 and all(isinstance(value, kind) for value in values)
