from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.records.certified_files import CHANNEL_NAMES, single_precision, write_certified_image
from raytruth.reference_tracer.certified_image import CertifiedImage
from tests.reproduction import note_case

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("RES-1")


def test_the_file_has_its_channels_by_name(tmp_path: Path) -> None:
    generator = np.random.default_rng(1)
    middle, radius = generator.random((4, 5, 3)), np.full((4, 5, 3), 1e-17)
    bits = np.full((4, 5), 128)
    bits[2, 3] = 4096
    path = tmp_path / "truth.exr"
    write_certified_image(path, CertifiedImage(middle, radius, bits, {}))
    source = OpenImageIO.ImageInput.open(str(path))
    names, pixels = source.spec().channelnames, np.asarray(source.read_image("float"))
    source.close()
    assert sorted(names) == sorted(CHANNEL_NAMES)
    assert [entry.name for entry in tmp_path.iterdir()] == ["truth.exr"]

    def channels(*wanted: str) -> NDArray[np.float64]:
        return np.stack([pixels[..., names.index(name)] for name in wanted], axis=-1).astype(np.float64)

    both = channels("R", "G", "B") + channels("residual.R", "residual.G", "residual.B")
    np.testing.assert_allclose(both, middle, rtol=2.0**-48)
    assert (np.abs(both - middle) <= channels("radius.R", "radius.G", "radius.B")).all()
    assert channels("precision_bits")[..., 0].tolist() == bits.tolist()


@given(st.floats(allow_nan=False), st.floats(min_value=0, allow_nan=False))
def test_value_residual_and_radius_in_float32_hold_all_that_float64_held(middle: float, radius: float) -> None:
    value, residual, wide = (float(part[0]) for part in single_precision(np.array([middle]), np.array([radius])))
    note_case(middle=middle, radius=radius, value=value, residual=residual, wide=wide)
    if not np.isfinite(wide):
        assert max(abs(middle), radius) >= float(np.finfo(np.float32).max) * (1 - 2.0**-24)
        return
    together = Fraction(value) + Fraction(residual)
    assert together - Fraction(wide) <= Fraction(middle) - Fraction(radius)
    assert Fraction(middle) + Fraction(radius) <= together + Fraction(wide)
    # Two float32 hold 48 bits or reach down to the smallest of them; rounding up adds less than one in 2^22.
    least = Fraction(radius) + abs(Fraction(middle)) / 2**48 + Fraction(2) ** -149
    assert Fraction(wide) <= least * (1 + Fraction(1, 2**22)) + Fraction(2) ** -149
