"""Permission to run Python in a replay: only for the host functions of a model, and only with a flag.

A run.json contains its model, so a replay runs no file. Host functions are the exception: they are Python, and stay in
the model's file. `--trust` lets a replay run the file that run.json names, if its bytes are unchanged; `--model FILE`
names another file. The bytes are compared before they are run. Afterwards each host function is compared with the
function of the search (`niwaki.search.data`).
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

#: The module of the package, whose functions need no permission.
PACKAGE = "niwaki"


def trusted(data: dict[str, Any], model: Path | None, trust: bool) -> tuple[str, ...]:
    """Return the modules whose host functions a replay may call; run the model's file if a flag allows it.

    Parameters
    ----------
    data
        A run.json.
    model
        The file of `--model`.
    trust
        Whether the file that run.json names may be run.

    Raises
    ------
    InputError
        `untrusted-file`: the model needs its file, and no flag allows to run it; `changed-model-file`: the bytes of the
        file have changed.
    """
    needed = list(hosts(data["search"]))
    of_package = {module for module, _, _ in needed if module.partition(".")[0] == PACKAGE}
    of_file = [function for function in needed if function[0] not in of_package]
    if not of_file:
        return tuple(sorted(of_package))
    model_file = Path(str(data["model"]).rpartition(":")[0])
    if model is None and not trust:
        module, name, _ = of_file[0]
        raise InputError("untrusted-file", name=f"{module}.{name}", file=model_file, where=_where(model_file))
    place = (model_file if model is None else model).resolve()
    if not place.is_file():
        raise InputError("unknown-model", name=str(place), reason=f"the file {place} does not exist")
    run_file(place, model_file.stem, None if model else _unchanged(place, data, of_file))
    # The file has imported the modules that it needs; no other module is imported for a run.json.
    return tuple(sorted(of_package | {module for module, _, _ in of_file if modules(module)}))


def hosts(data: Any) -> Iterator[tuple[str, str, str]]:
    """Yield module, name and hash of each host function in the data of a search."""
    waiting = [data]
    while waiting:
        node = waiting.pop()
        host = node.get("host") if isinstance(node, dict) else None
        if isinstance(host, dict):
            module, name, digest = (str(host.get(key)) for key in ("module", "name", "sha256"))
            yield module, name, digest
        elif isinstance(node, (dict, list)):
            waiting.extend(node.values() if isinstance(node, dict) else node)


def _where(place: Path) -> str:
    """Describe a file as inside or outside of the working folder."""
    inside = place.resolve().is_relative_to(Path.cwd())
    return "a file of this folder" if inside else "a file outside of this folder"


def _unchanged(
    place: Path, data: dict[str, Any], needed: list[tuple[str, str, str]]
) -> Callable[[bytes], None]:
    """Return a check that refuses bytes that differ from those that the search has run."""

    def check(source: bytes) -> None:
        expected, digest = data.get("file_hash"), hashlib.sha256(source).hexdigest()
        if expected != digest:
            then = "no hash" if expected is None else f"SHA-256 {expected[:12]}..."
            differs = _different(source, needed)
            raise InputError(
                "changed-model-file", path=place, then=then, found=f"{digest[:12]}...", differs=differs
            )

    return check


def _different(source: bytes, needed: list[tuple[str, str, str]]) -> str:
    """Describe which host functions of a source have changed; the source is read and not run."""
    try:
        body = ast.parse(source).body
    except (SyntaxError, ValueError, RecursionError):
        return "it is not Python any more"
    hashes = {
        function.name: text_hash(ast.dump(ast.Module([function], [])))
        for function in body
        if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef))
    }
    changed = sorted({name for _, name, digest in needed if hashes.get(name) != digest})
    if not changed:
        return "only lines outside of its host functions have changed"
    return f"changed or removed: {', '.join(f'`{name}`' for name in changed)}"
