from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.root_tower import (
    MOST_ROOTS,
    ONE,
    NotExactError,
    RootTower,
    constant,
    is_zero,
    negate,
)
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.reference_tracer.arithmetics.root_tower import Element

pytestmark = pytest.mark.clause("ARI-3")

PLENTY = 10**7


@pytest.fixture(autouse=True, scope="module")
def _precision() -> Iterator[None]:
    with ctx.workprec(256):
        yield


def tower_with_symbol() -> tuple[RootTower, Element]:
    """The symbol stands for a number near 0.7."""
    tower = RootTower(PLENTY)
    return tower, tower.symbol(arb(7) / 10)


RADICANDS = st.lists(st.integers(2, 30), min_size=1, max_size=3)
PARTS = st.lists(st.integers(-5, 5), min_size=4, max_size=4)


def mixed(tower: RootTower, symbol: Element, radicands: list[int], parts: list[int]) -> Element:
    """A sum of the symbol, roots of roots and whole numbers, each so many times."""
    total = constant(fmpq(parts[0], 3))
    total = tower.add(total, tower.multiply(symbol, constant(parts[1])))  # type: ignore[assignment]
    inner: Element = tower.multiply(symbol, symbol)
    for radicand, part in zip(radicands, parts[1:], strict=False):
        inner = tower.square_root(tower.add(constant(radicand), inner))
        total = tower.add(total, tower.multiply(constant(part), inner))  # type: ignore[assignment]
    return total


@given(RADICANDS, PARTS, PARTS)
def test_elements_obey_the_rules_of_a_field_and_lie_in_their_balls(
    radicands: list[int], parts: list[int], others: list[int]
) -> None:
    note_case(radicands=radicands, parts=parts, others=others)
    tower, symbol = tower_with_symbol()
    x, y = (mixed(tower, symbol, radicands, each) for each in (parts, others))
    of_x, of_y = tower.ball(x), tower.ball(y)
    product, total = tower.multiply(x, y), tower.add(x, y)
    assert tower.ball(product).overlaps(of_x * of_y)
    assert tower.ball(total).overlaps(of_x + of_y)
    assert is_zero(tower.add(total, negate(tower.add(y, x))))
    assert is_zero(tower.add(product, negate(tower.multiply(y, x))))
    if not is_zero(x):
        assert tower.ball(tower.inverse(x)).overlaps(1 / of_x)
        assert is_zero(tower.add(tower.multiply(x, tower.inverse(x)), negate(ONE)))
        assert is_zero(x) == bool(of_x.contains(arb(0)))  # that close to 0 none of these comes


@given(RADICANDS, PARTS)
def test_the_root_of_a_square_is_found_in_the_tower_with_its_sign(radicands: list[int], parts: list[int]) -> None:
    note_case(radicands=radicands, parts=parts)
    tower, symbol = tower_with_symbol()
    x = mixed(tower, symbol, radicands, parts)
    roots = len(tower.radicands)
    root = tower.square_root(tower.multiply(x, x))
    assert len(tower.radicands) == roots
    assert is_zero(tower.add(root, negate(x) if tower.ball(x) >= 0 else x))


@pytest.mark.parametrize(("a", "b"), [(2, 3), (8, 2), (5, 20), (7, 11), (fmpq(1, 2), 3)])
def test_roots_that_depend_on_others_are_told_so(a: int, b: int) -> None:
    tower = RootTower(PLENTY)
    root_a, root_b, root_of_both = (tower.square_root(constant(n)) for n in (a, b, fmpq(a) * b))
    assert is_zero(tower.add(tower.multiply(root_a, root_b), negate(root_of_both)))
    # √(a + b + 2·√(ab)) = √a + √b
    nested = tower.add(constant(fmpq(a) + b), tower.multiply(constant(2), root_of_both))
    assert is_zero(tower.add(tower.square_root(nested), negate(tower.add(root_a, root_b))))
    assert len(tower.radicands) <= 2


def test_what_is_nearly_zero_is_not_zero() -> None:
    tower = RootTower(PLENTY)
    root = tower.square_root(constant(2))
    convergent = fmpq(6369051672525773, 4503599627370497)  # of √2, as near as such numbers come
    assert not is_zero(tower.add(root, constant(-convergent)))
    with pytest.raises(NotExactError):
        tower.square_root(constant(-1))


def test_a_quotient_by_what_may_vanish_where_the_symbol_is_is_not_known() -> None:
    tower = RootTower(PLENTY)
    symbol = tower.symbol(arb(1, 2.0**-100))
    with pytest.raises(NotExactError):
        tower.inverse(tower.add(symbol, negate(ONE)))
    with pytest.raises(NotExactError):
        tower.symbol(arb(2))


def test_a_tower_gives_up_on_too_many_roots_and_on_too_much_work() -> None:
    tower = RootTower(PLENTY)
    primes = (2, 3, 5, 7, 11, 13, 17, 19)
    for prime in primes[:MOST_ROOTS]:
        tower.square_root(constant(prime))
    with pytest.raises(NotExactError):
        tower.square_root(constant(primes[MOST_ROOTS]))
    lazy = RootTower(0)
    with pytest.raises(NotExactError):
        lazy.multiply(ONE, ONE)
    assert lazy.work > 0
