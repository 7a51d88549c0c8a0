import numba
import pytest

from raytruth.reference_tracer.arithmetics.compiled_stack import CAPACITY, height_of, new_stack, pop, push

pytestmark = pytest.mark.clause("ARI-1")


@numba.njit(_nrt=False)  # as kernels are, but not kept: what is kept would not notice a change of the stack
def take_all_but_first(count: int) -> int:
    """Puts 0 to count - 1 on a stack of pairs; takes all but the first off again, as the digits of a number."""
    stack = new_stack((0, 0.0))
    for item in range(1, count):
        push(stack, (item, 0.5 * item))
    digits = 0
    while height_of(stack) > 1:
        whole, half = pop(stack)
        digits = 10 * digits + whole
        if half != 0.5 * whole:
            return -1
    return digits


def test_the_last_ray_put_there_is_taken_first() -> None:
    assert take_all_but_first(5) == 4321


def test_a_stack_that_is_full_takes_no_more() -> None:
    take_all_but_first(CAPACITY)
    with pytest.raises(MemoryError, match="deeper than any scene"):
        take_all_but_first(CAPACITY + 1)
