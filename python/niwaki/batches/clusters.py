"""Clusters as executors: Ray by an adapter, Dask by the executor that it has. Both are optional libraries.

Without an address a cluster of this machine is started, which listens on the loopback only, and is ended. Neither asks
anything of the network outside of it.
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

#: So often Ray itself starts a task again whose worker was lost.
RETRIES = 3

#: What keeps Ray from reporting anything.
SILENT = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_USAGE_STATS_REPORT_URL": "http://127.0.0.1:9"}

#: What keeps a Ray of this machine on the loopback; else it asks which address others would see.
LOCAL = {"RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0"}

#: Where Ray looks for the cluster's own settings, in the home folder; where it finds none it asks the cloud for them.
SETTINGS = "ray_bootstrap_config.yaml"


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
    """Inside, variables of the environment have these values, for processes that are started."""
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
