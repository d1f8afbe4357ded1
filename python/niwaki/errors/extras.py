"""Optional libraries: the extras, their uses, and the error about a missing library."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Any

from niwaki.errors.files import FileError

#: The use of each extra. The package's metadata lists the libraries of each extra.
EXTRAS = {
    "arviz": "plots and tables of draws by ArviZ (`result.to_arviz()`)",
    "cluster": "batches on Ray or Dask (`niwaki batch --engine`)",
    "color": "pictures of coloured drawings (`niwaki color`)",
    "mcp": "the studio's messages as tools for programs that write models (`niwaki mcp`)",
    "notebook": "a viewer in a notebook whose results can be replaced (`niwaki.view(...).widget()`)",
    "parquet": "a batch's table as Parquet (`niwaki batch export --format parquet`)",
    "print": "files of solids with holes, one closed solid for a printer (`--format stl`, `--format 3mf`)",
    "stacks": "judging structures of blocks, and their cutting sheets (`niwaki.stacks`)",
    "studio": "the studio, a page in your browser (`niwaki studio`)",
}


def install(extra: str) -> str:
    """Return the command that installs an extra."""
    return f"pip install 'niwaki[{extra}]'"


def optional(module: str, task: str, extra: str, instead: str = "") -> Any:
    """Import a library of an extra.

    Parameters
    ----------
    module
        The library, or a module of this package that needs it.
    task
        The task that needs the library, in words.
    extra
        A name of `EXTRAS`.
    instead
        Another way to do the task, in words.

    Raises
    ------
    FileError
        `missing-extra`: a library is not installed; `broken-extra`: a library is installed and does not load.
    """
    try:
        return import_module(module)
    except (ImportError, OSError) as error:
        lacks = (error.name or "").partition(".")[0] if isinstance(error, ModuleNotFoundError) else ""
        if lacks == "niwaki":
            raise
        # Some systems lack modules of Python's standard library.
        if lacks and lacks not in sys.stdlib_module_names:
            cure = f"install it with `{install(extra)}`" + (f", or {instead}" if instead else "")
            raise FileError("missing-extra", task=task, extra=extra, cure=cure) from None
        reason = " ".join(str(error).split()) or type(error).__name__
        raise FileError("broken-extra", task=task, extra=extra, module=module, reason=reason) from error
