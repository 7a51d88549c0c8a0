from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from flint import arb, ctx
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.double_double_balls import DoubleDoubleBall, to_float_ball, two_sum
from raytruth.reference_tracer.arithmetics.double_double_functions import exp, power, tan
from tests.reference_tracer.arithmetics.ball_draws import holds
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("many_bits"), pytest.mark.clause("ARI-11")]


@pytest.fixture
def many_bits() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = 300
        yield


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    x=st.floats(0.01, 1.5),
    part=st.floats(-1, 1),
    radius=st.sampled_from([0.0, 2.0**-100, 2.0**-60, 2.0**-10]),
    exponent=st.floats(0.5, 200),
    inner=st.sampled_from([-1.0, 0.3, 1.0]),
)
def test_a_function_of_a_double_double_ball_holds_its_values_to_a_floats_digits(
    x: float, part: float, radius: float, exponent: float, inner: float
) -> None:
    ball = DoubleDoubleBall(*two_sum(x, x * part * 2.0**-53), radius)
    point = arb(ball.high) + arb(ball.low) + arb(radius) * arb(inner)
    of_exp, of_power = exp(ball, 0.0), power(ball, DoubleDoubleBall(exponent, 0.0, 0.0), 0.0)
    assert holds(to_float_ball(of_exp), point.exp())
    assert holds(to_float_ball(of_power), point ** arb(exponent))
    assert holds(to_float_ball(tan(ball, 0.0)), point.tan())
    assert of_exp.radius <= of_exp.high * (2.0 * radius + 2.0**-49)
    if radius == 0.0:
        shown = of_power.high > 2.0**-20
        assert not shown or of_power.radius <= of_power.high * exponent * 2.0**-48
