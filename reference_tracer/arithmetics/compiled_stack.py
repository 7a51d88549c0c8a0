"""What compiled kernels are made of beside the tracer's source: how they are compiled, and their stack of rays.

A list of the compiler's lives on the heap, and everything on the heap, the scene's arrays too, is then counted by
atomic operations, several a ray, for whose cache line all threads compete: more than half of the time of a picture
with mirrors. This stack lives on the machine's stack, and the kernels do without counting.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numba
from numba.core import cgutils
from numba.extending import intrinsic

from raytruth.scenes.scene import LARGEST_DEPTH

if TYPE_CHECKING:
    from collections.abc import Callable

    Ray = tuple[Any, ...]
    Stack = tuple[Any, Any]

# The compiler's annotations know neither these options nor these functions.
njit: Any = numba.njit
types: Any = numba.types
storage: Any = cgutils

# Tracing takes one ray from the stack and puts at most three there, each one level deeper: a mirror's and two of a
# dielectric. So the stack grows by two a level at most, from the one camera ray on.
CAPACITY = 2 * LARGEST_DEPTH + 1

inlined: Callable[[Callable[..., Any]], Callable[..., Any]] = njit(
    # Division by zero gives infinity as in IEEE 754, not an exception.
    error_model="numpy",
    # Passing a scene costs more than most functions do with it.
    forceinline=True,
    # Only what Python calls needs wrappers for it, which take most of the time to compile.
    no_cpython_wrapper=True,
    no_cfunc_wrapper=True,
    # No counting of references: nothing here outlives the arrays that Python passes.
    _nrt=False,
)
entry_point: Callable[[Callable[..., Any]], Callable[..., Any]] = njit(
    # Threads share the rows.
    nogil=True,
    cache=True,
    error_model="numpy",
    no_cfunc_wrapper=True,
    _nrt=False,
)


@intrinsic
def new_stack(typing_context: Any, ray: Any) -> Any:  # noqa: ARG001 - the compiler passes it
    """A stack that holds one ray: a pointer to the rays, and one to their number. It lives as long as its caller."""
    stack = types.Tuple((types.CPointer(ray), types.CPointer(types.intp)))

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        rays = storage.alloca_once(builder, context.get_data_type(ray), size=CAPACITY)
        height = storage.alloca_once_value(builder, context.get_constant(types.intp, 1))
        builder.store(arguments[0], rays)
        return context.make_tuple(builder, signature.return_type, [rays, height])

    return stack(ray), generate


@inlined
def height_of(stack: Stack) -> int:
    """How many rays there are."""
    height: int = stack[1][0]
    return height


@inlined
def push(stack: Stack, ray: Ray) -> None:
    """Put a ray on top. Raises MemoryError where there is no room, which only a faulty tracer can bring about."""
    rays, height = stack
    if height[0] == CAPACITY:
        raise MemoryError("the ray tree is deeper than any scene allows")
    rays[height[0]] = ray
    height[0] += 1


@inlined
def pop(stack: Stack) -> Ray:
    """Take the top ray away."""
    rays, height = stack
    height[0] -= 1
    ray: Ray = rays[height[0]]
    return ray
