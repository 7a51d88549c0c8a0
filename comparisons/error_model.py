"""Error models: what a renderer declares about its arithmetic, and from which its tolerance is derived."""

from __future__ import annotations

from dataclasses import dataclass, field

from comparisons.output_model import OutputModel


@dataclass(frozen=True)
class ErrorModel:
    """How a renderer's result may differ from the truth by its arithmetic alone; the same for all scenes."""

    description: str
    precision_bits: int
    """Significand bits of its arithmetic, less the bits that another order of operations may cost."""
    ray_offset: float = 0.0
    """Secondary rays start at p + n·offset·(1 + max|p|); 0: they start on the surface."""
    shadow_shortening: float = 0.0
    """Shadow rays end at this fraction of the light's distance before the light."""
    output: OutputModel = field(default_factory=OutputModel)
