"""What all tables of a declaration have in common."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Part(BaseModel):
    """A part of a declaration: immutable, and without keys that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)
