"""Clusters as executors: Ray by an adapter, Dask by the executor that it has. Both are optional libraries.

Without an address a cluster of this machine is started, which listens on the loopback only, and is ended. Neither asks
anything of the network outside of it.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from typing import Any

from niwaki.errors.extras import optional

#: So often Ray itself starts a task again whose worker was lost.
RETRIES = 3

#: What keeps Ray silent, and closed to others; what the person has set stays.
SETTINGS = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_USAGE_STATS_REPORT_URL": "http://127.0.0.1:9",
    "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0",
}


class RayExecutor(Executor):
    """An executor whose tasks run where Ray has room.

    Parameters
    ----------
    library
        The module `ray`, which is connected.
    """

    def __init__(self, library: Any) -> None:
        self._remote: Callable[..., Any] = library.remote(max_retries=RETRIES)(_call).remote

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Run a function on the cluster."""
        future: Future[Any] = self._remote(fn, args, kwargs).future()
        return future


def _call(function: Callable[..., Any], args: Any, kwargs: Any) -> Any:
    return function(*args, **kwargs)


@contextmanager
def ray(processes: int, address: str | None = None) -> Iterator[Executor]:
    """An executor of Ray: of the cluster at an address, or of so many processes here.

    Raises
    ------
    FileError
        Ray is not installed.
    """
    for name, value in SETTINGS.items():
        os.environ.setdefault(name, value)
    library = optional("ray", "a batch on Ray", "cluster")
    own = {"num_cpus": processes, "include_dashboard": False, "_node_ip_address": "127.0.0.1"}
    library.init(address=address or "local", log_to_driver=False, **({} if address else own))
    try:
        yield RayExecutor(library)
    finally:
        library.shutdown()


@contextmanager
def dask(processes: int, address: str | None = None) -> Iterator[Executor]:
    """An executor of Dask: of the scheduler at an address, or of so many processes here.

    Raises
    ------
    FileError
        Dask is not installed.
    """
    library = optional("distributed", "a batch on Dask", "cluster")
    own = {
        "n_workers": processes,
        "threads_per_worker": 1,
        "host": "127.0.0.1",
        "dashboard_address": None,
        "processes": True,
    }
    with library.Client(address, set_as_default=False) if address else library.Client(**own) as client:
        yield client.get_executor(pure=False)


#: The clusters by the names that are typed.
ENGINES = {"ray": ray, "dask": dask}
