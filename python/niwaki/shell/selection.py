"""Results of a search by their numbers from 1, as captions and lines show them (`#3`).

--run 3            result #3
--export 3,5       results #3 and #5, as files `run-3.glb`, `run-5.glb`
--export all       all results
"""

from __future__ import annotations

from typing import Annotated

import typer

from niwaki.errors import InputError

Export = Annotated[
    str | None,
    typer.Option(
        "--export",
        metavar="LIST",
        help="Also write these results, by their numbers: 3,5 or all. Files are run-3.glb, ...",
    ),
]
RunNumber = Annotated[
    int | None, typer.Option("--run", metavar="N", help="Number of the result, #N. Default: the best.")
]


def place(number: int | None, count: int, best: int) -> int:
    """Return the index of the result with a number from 1; without a number, the index of the best."""
    if number is None:
        return best
    if not 1 <= number <= count:
        raise _refused(
            "--run", repr(number), count, f"such a number; without `--run` you get the best, {best + 1}"
        )
    return number - 1


def exported(text: str | None, count: int) -> list[int]:
    """Return the numbers of `--export`, from 1."""
    if text is None:
        return []
    if text.strip() == "all":
        return list(range(1, count + 1))
    parts = [part.strip().removeprefix("#") for part in text.split(",")]
    if not all(part.isdecimal() and 1 <= int(part) <= count for part in parts):
        raise _refused("--export", repr(text), count, "such numbers with commas between them, or all")
    return list(dict.fromkeys(int(part) for part in parts))


def _refused(flag: str, value: str, count: int, suggestion: str) -> InputError:
    among = f"of the {count} results of this search, from 1 to {count}" if count > 1 else "1, the only result"
    return InputError(
        "bad-setting", name=flag, found=value, expected=f"the number {among}", suggestion=suggestion
    )
