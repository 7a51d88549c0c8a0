"""Who grades submissions: processes of this machine, or the workers of a Dask cluster.

A cluster is any that `dask scheduler` and `dask worker` make. Its workers must see the submissions under the same
paths and have the same raytruth; they grade each submission in a process of its own, as this machine does, so that
results are equal. They need no access to the folder of results, which only the run itself writes. When a worker dies,
the scheduler gives its submissions to others; a submission that workers keep dying of is an error of the grader.
"""

from __future__ import annotations

from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.apart import end_all

if TYPE_CHECKING:
    from collections.abc import Iterator

# To find out that there is no scheduler at an address.
_CONNECT_SECONDS = 15


class ClusterError(Exception):
    """A cluster cannot be used; the message is one sentence."""


@contextmanager
def local_workers(count: int) -> Iterator[tuple[Executor, int]]:
    """So many threads, each of which waits for a process of its own at a time, and their number."""
    pool = ThreadPoolExecutor(count)
    try:
        yield pool, count
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        end_all()


@contextmanager
def cluster_workers(address: str) -> Iterator[tuple[Executor, int]]:
    """The workers of the Dask cluster at this address, and how many tasks they work at. Raises ClusterError."""
    try:
        import distributed  # noqa: PLC0415 - an extra, which few have
    except ImportError as error:
        raise ClusterError("--scheduler needs Dask: pip install 'raytruth[cluster]'.") from error
    try:
        client = distributed.Client(address, timeout=_CONNECT_SECONDS, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ClusterError(f"--scheduler: there is no Dask scheduler at {address} ({type(error).__name__}).") from error
    with client:
        threads = sum(client.nthreads().values())
        if not threads:
            raise ClusterError(
                f"--scheduler: the cluster at {address} has no workers; start some: dask worker {address}"
            )
        yield client.get_executor(pure=False), threads
