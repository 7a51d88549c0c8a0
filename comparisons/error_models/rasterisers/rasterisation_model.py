"""How a rasteriser draws triangles, as an error model declares it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Rasterisation:
    """How triangles are drawn with a z-buffer; what that may do to a pixel is derived in rasterisation.py."""

    subpixel_bits: int
    """Corners are snapped to 2^-subpixel_bits of a pixel to tell what they cover."""
    depth_bits: int
    """Depths are kept to 2^-depth_bits of the way from the near to the far plane (view_volume.py)."""
    light_bits: int
    """As `precision_bits` of the error model, of the lighting equation: slack for another order of it included."""

    def in_words(self) -> str:
        """The rasterisation as a clause for people, as in `raytruth renderers`."""
        grid = f"with corners snapped to 2^-{self.subpixel_bits} of a pixel"
        buffer = f"in a z-buffer of {self.depth_bits} bits between planes tight around what is seen"
        return f"triangles {grid}, {buffer}; an operation of their light errs by at most 2^-{self.light_bits}"
