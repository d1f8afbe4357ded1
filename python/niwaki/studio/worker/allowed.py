"""Which files of Python may be run for a stored run: those that were named at the start, and with `--trust` others.

A stored run has its model inside, and needs no file. Only host functions are Python, and stay in the model's file: one
that was named at the start is run as it is, since a person named it; one that is only named in the run is run with
`--trust`, where its bytes are those of then (`niwaki.shell.trust`). Each host function is compared with the one that
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
from niwaki.studio.refused import Refused
from niwaki.studio.worker import models
from niwaki.studio.worker.loading import loading

_trust: list[bool] = [False]


def take(words: Sequence[str]) -> None:
    """What the studio was started with: references of files, and `--trust`."""
    _trust[0] = "--trust" in words
    for reference in words:
        if reference != "--trust":
            models.named[Path(reference.rpartition(":")[0] or reference).resolve()] = reference


def modules(data: dict[str, Any]) -> tuple[str, ...]:
    """The modules whose host functions a stored run may call; runs their file where that is allowed.

    Raises
    ------
    Refused
        `untrusted-file`, in the studio's words.
    InputError
        `changed-model-file`.
    """
    needed = {module for module, _, _ in hosts(data["search"])}
    if not needed:
        return ()
    named = Path(str(data["model"]).rpartition(":")[0])
    reference = models.named.get(named.resolve())
    if reference is not None:
        # Run at most once for each state of the file.
        models.reference(reference)
        prefer(named.resolve())
        return tuple(sorted(module for module in needed if run_modules(module)))
    try:
        with loading(named):
            return trusted(data, None, _trust[0])
    except InputError as error:
        if error.code != "untrusted-file":
            raise
        text = (
            f"this result calls Python functions of {named}, which was not named when the studio was started.\n"
            f"Read that file; then start the studio with it, or with `--trust`, which runs it where it is unchanged."
        )
        raise Refused(error.code, text) from None
