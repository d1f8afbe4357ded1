"""Clusters as executors: Ray by an adapter, Dask by its own executor. Both are optional libraries.

Without an address, a cluster is started on this machine, which listens on the loopback only and ends with the batch.
Neither library sends requests to the network outside of the cluster.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, Future
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from niwaki.errors.extras import optional

#: How often Ray starts a task again after its worker is lost.
RETRIES = 3

#: Variables that turn off Ray's reports of usage.
SILENT = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_USAGE_STATS_REPORT_URL": "http://127.0.0.1:9"}

#: Variables that keep a local Ray on the loopback; otherwise it asks the network for the machine's address.
LOCAL = {"RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0"}

#: The file with a cluster's settings in the home folder; without the file Ray asks the cloud for them.
SETTINGS = "ray_bootstrap_config.yaml"


class RayExecutor(Executor):
    """An executor whose tasks run on Ray.

    Parameters
    ----------
    library
        The module `ray`, connected to a cluster.
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
    """Yield an executor of Ray: of the cluster at an address, or of processes on this machine.

    Raises
    ------
    FileError
        Ray is not installed.
    """
    with ExitStack() as stack:
        if address is not None:
            with _environment(SILENT):
                library = optional("ray", "a batch on Ray", "cluster")
                library.init(address=address, log_to_driver=False)
        else:
            home = stack.enter_context(TemporaryDirectory(prefix="niwaki-ray-", ignore_cleanup_errors=True))
            Path(home, SETTINGS).write_text("{}\n")
            with _environment({**SILENT, **LOCAL, "HOME": home}):
                library = optional("ray", "a batch on Ray", "cluster")
                library.init(
                    address="local", num_cpus=processes, include_dashboard=False, log_to_driver=False
                )
        stack.callback(library.shutdown)
        yield RayExecutor(library)


@contextmanager
def _environment(values: Mapping[str, str]) -> Iterator[None]:
    """Set variables of the environment inside the context, for processes that start there."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def dask(processes: int, address: str | None = None) -> Iterator[Executor]:
    """Yield an executor of Dask: of the scheduler at an address, or of processes on this machine.

    Raises
    ------
    FileError
        Dask is not installed.
    """
    library = optional("distributed", "a batch on Dask", "cluster")
    local_settings = {
        "n_workers": processes,
        "threads_per_worker": 1,
        "host": "127.0.0.1",
        "dashboard_address": None,
        "processes": True,
    }
    with (
        library.Client(address, set_as_default=False)
        if address
        else library.Client(**local_settings) as client
    ):
        yield client.get_executor(pure=False)


#: The clusters by their names on the command line.
ENGINES = {"ray": ray, "dask": dask}
