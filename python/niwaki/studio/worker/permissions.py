"""Permissions of Python files: the files that the worker may run for the host functions of a stored run.

A stored run contains its model and needs no file for it. Only host functions are Python and stay in the model's file. A
file that was named at the start may run, because a person named it. A file that only the run names may run with
`--trust` if its bytes have not changed (`niwaki.shell.trust`). Each host function is compared with the function that
was called.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.inputs.modules import modules as run_modules
from niwaki.inputs.modules import prefer
from niwaki.shell.trust import hosts, trusted
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import confinement, models
from niwaki.studio.worker.loading import loading

#: The beginnings of words that name a folder whose files may run, and one below which a worker may write.
BELOW, WRITTEN = "--below=", "--written="

_trust: list[bool] = [False]


def configure(words: Sequence[str]) -> None:
    """Set the permissions from the words of the command line: references of files, folders, and `--trust`."""
    _trust[0] = "--trust" in words
    written: list[Path] = []
    for reference in words:
        if reference.startswith(WRITTEN):
            written.append(Path(reference.removeprefix(WRITTEN)).resolve())
        elif reference.startswith(BELOW):
            models.folders.append(Path(reference.removeprefix(BELOW)).resolve())
        elif reference != "--trust":
            models.named[Path(reference.rpartition(":")[0] or reference).resolve()] = reference
    if written:
        confinement.confine(written)


def modules(data: dict[str, Any]) -> tuple[str, ...]:
    """Return the modules whose host functions a stored run may call; run their file if that is allowed.

    Raises
    ------
    CommandError
        `untrusted-file`.
    InputError
        `changed-model-file`.
    """
    needed = {module for module, _, _ in hosts(data["search"])}
    if not needed:
        return ()
    named = Path(str(data["model"]).rpartition(":")[0])
    real = named.resolve()
    is_below = any(real.is_relative_to(folder) for folder in models.folders)
    reference = str(data["model"]) if is_below else models.named.get(real)
    if reference is not None:
        # The file is run at most once for each of its states.
        models.reference(reference)
        prefer(real)
        return tuple(sorted(module for module in needed if run_modules(module)))
    try:
        with loading(named):
            return trusted(data, None, _trust[0])
    except InputError as error:
        if error.code != "untrusted-file":
            raise
        text = (
            f"this result calls Python functions of {named}, which was not named when the studio was started.\n"
            f"Read that file; then start the studio with it, or with `--trust`, which runs the file if it is unchanged."
        )
        raise CommandError(error.code, text) from None
