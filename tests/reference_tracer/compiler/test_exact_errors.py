"""A product's rounding error is exact: in Python, and as machine code on processors of either kind."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.compiler import typed_expressions
from raytruth.reference_tracer.compiler.exact_errors import product_error
from raytruth.reference_tracer.compiler.machine_code import has_fused_product
from tests.reference_tracer.compiler.programs import NUMBER, compiled, program
from tests.reference_tracer.compiler.programs import NUMBERS as ARRAY

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("ARI-12")

TEXT = "def run(a, b, results):\n    results[0] = product_error(a, b)\n"
KINDS = (NUMBER, NUMBER, ARRAY)
NAMES = {"product_error": product_error}
# Their product neither overflows nor has bits below the smallest float.
NUMBERS = st.floats(2.0**-400, 2.0**400) | st.floats(-(2.0**400), -(2.0**-400))


@pytest.mark.parametrize("is_fused", sorted({has_fused_product(), False}))
def test_the_error_is_exact_in_every_way(is_fused: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(typed_expressions, "has_fused_product", lambda: is_fused)
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))  # what is compiled is kept, and does not depend on the patch
    assert ("llvm.fma" in program(TEXT, *KINDS, names=NAMES).ir_text()) == is_fused
    run, result = compiled(TEXT, *KINDS, names=NAMES), np.zeros(1)

    @given(NUMBERS, NUMBERS)
    def is_exact(a: float, b: float) -> None:
        run(a, b, result)
        exact = Fraction(a) * Fraction(b) - Fraction(a * b)
        assert Fraction(product_error(a, b)) == exact, (a.hex(), b.hex())
        assert Fraction(result[0]) == exact, (a.hex(), b.hex())

    is_exact()
