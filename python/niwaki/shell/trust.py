"""When a replay runs Python: only for the host functions of a model, and only when a person says so.

A run.json has its model inside, so that a replay runs no file. A model that calls host functions needs them: they are
Python, and stay in the file of the model. `--trust` lets a replay run the file that run.json names, where its bytes are
those that were run then; `--model FILE` names another. The bytes are compared before they are run. Afterwards each
host function is compared with the one that was called (`niwaki.search.data`).
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.inputs.modules import modules, run_file
from niwaki.search.data import text_hash

#: The package's own functions are as trusted as the package.
OWN = "niwaki"


def trusted(data: dict[str, Any], model: Path | None, trust: bool) -> tuple[str, ...]:
    """The modules whose host functions a replay may call; runs a file where that was allowed.

    Parameters
    ----------
    data
        A run.json.
    model
        The file that a person named.
    trust
        Whether the file that run.json names may be run.

    Raises
    ------
    InputError
        `untrusted-file`: the model needs its file, and nobody allowed to run it; `changed-model-file`: its bytes are
        not those that were run then.
    """
    needed = list(hosts(data["search"]))
    own = {module for module, _, _ in needed if module.partition(".")[0] == OWN}
    others = [one for one in needed if one[0] not in own]
    if not others:
        return tuple(sorted(own))
    named = Path(str(data["model"]).rpartition(":")[0])
    if model is None and not trust:
        module, name, _ = others[0]
        raise InputError("untrusted-file", name=f"{module}.{name}", file=named, where=_where(named))
    place = (named if model is None else model).resolve()
    if not place.is_file():
        raise InputError("unknown-model", name=str(place), reason=f"there is no file {place}")
    run_file(place, named.stem, None if model else _unchanged(place, data, others))
    # Running the file has imported what it needs; nothing else is imported for a run.json.
    return tuple(sorted(own | {module for module, _, _ in others if modules(module)}))


def hosts(data: Any) -> Iterator[tuple[str, str, str]]:
    """Module, name and hash of the host functions of a search as data."""
    waiting = [data]
    while waiting:
        one = waiting.pop()
        host = one.get("host") if isinstance(one, dict) else None
        if isinstance(host, dict):
            module, name, digest = (str(host.get(key)) for key in ("module", "name", "sha256"))
            yield module, name, digest
        elif isinstance(one, (dict, list)):
            waiting.extend(one.values() if isinstance(one, dict) else one)


def _where(place: Path) -> str:
    """Whether a file is below the working folder, for people."""
    inside = place.resolve().is_relative_to(Path.cwd())
    return "a file of this folder" if inside else "a file outside of this folder"


def _unchanged(
    place: Path, data: dict[str, Any], needed: list[tuple[str, str, str]]
) -> Callable[[bytes], None]:
    """A check that the bytes that are about to be run are those that were run then."""

    def check(source: bytes) -> None:
        wanted, found = data.get("file_hash"), hashlib.sha256(source).hexdigest()
        if wanted != found:
            then = "no hash" if wanted is None else f"SHA-256 {wanted[:12]}..."
            differs = _different(source, needed)
            raise InputError(
                "changed-model-file", path=place, then=then, found=f"{found[:12]}...", differs=differs
            )

    return check


def _different(source: bytes, needed: list[tuple[str, str, str]]) -> str:
    """Which host functions of a source are others than they were; it is read and not run."""
    try:
        body = ast.parse(source).body
    except (SyntaxError, ValueError, RecursionError):
        return "it is no Python any more"
    hashes = {
        one.name: text_hash(ast.dump(ast.Module([one], [])))
        for one in body
        if isinstance(one, (ast.FunctionDef, ast.AsyncFunctionDef))
    }
    changed = sorted({name for _, name, digest in needed if hashes.get(name) != digest})
    if not changed:
        return "the host functions that it calls are the same, other lines are not"
    return f"other than they were, or gone: {', '.join(f'`{name}`' for name in changed)}"
